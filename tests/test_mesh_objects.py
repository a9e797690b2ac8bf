"""One mesh object in the place of V and F: told by its attributes, with an error that says what is taken."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from meshes_closed import icosphere

import conformal_uv as cuv
from conformal_uv.mesh.mesh_objects import polygons_of, triangles_of
from conformal_uv.samples import mask

V, F = mask(300)
V = np.asarray(V)


def padded(rows) -> np.ndarray:
    return np.concatenate([[len(row), *row] for row in rows])


def corner_lists(polygons) -> list[list[int]]:
    if isinstance(polygons, cuv.PolygonMesh):
        return [part.tolist() for part in np.split(polygons.corners, polygons.starts[1:-1])]
    return np.asarray(polygons).tolist()


OBJECTS = {
    "a pair": (V, F),
    "lists": (V.tolist(), F.tolist()),
    "trimesh": SimpleNamespace(vertices=V, faces=F, triangles=V[F]),
    "pyvista": SimpleNamespace(points=V, faces=padded(F), n_strips=0),
    "meshio": SimpleNamespace(points=V, cells_dict={"vertex": np.zeros((1, 1), int), "triangle": F}),
    "open3d": SimpleNamespace(vertices=V, triangles=F),
    "PolygonMesh": cuv.PolygonMesh(V, F.reshape(-1).astype(np.int64), np.arange(0, F.size + 1, 3)),
}


@pytest.mark.parametrize("kind", OBJECTS)
def test_every_door_takes_one_object(kind: str) -> None:
    mesh = OBJECTS[kind]
    assert np.array_equal(cuv.disk_map(mesh).uv, cuv.disk_map(V, F).uv)
    assert np.array_equal(cuv.free_map(mesh).uv, cuv.free_map(V, F).uv)
    assert np.array_equal(cuv.rectangle_map(mesh).uv, cuv.rectangle_map(V, F).uv)
    assert np.array_equal(cuv.unwrap(mesh).uv, cuv.unwrap(V, F).uv)
    assert np.array_equal(cuv.sphere_map(mesh, boundary="cap").xyz, cuv.sphere_map(V, F, boundary="cap").xyz)
    for mapper in (cuv.DiskMapper(mesh), cuv.ShapeMapper(mesh)):
        assert mapper.surface.n == len(V)
    assert cuv.Unwrapper(mesh).unwrap(method="linear").mapped.all()


def test_the_libraries_own_objects() -> None:
    ball, faces = icosphere(1)
    expected = cuv.sphere_map(ball, faces).xyz
    trimesh, meshio = pytest.importorskip("trimesh"), pytest.importorskip("meshio")
    assert np.array_equal(cuv.sphere_map(trimesh.Trimesh(ball, faces, process=False)).xyz, expected)
    assert np.array_equal(cuv.sphere_map(meshio.Mesh(ball, [("triangle", faces)])).xyz, expected)
    pyvista = pytest.importorskip("pyvista")
    found = cuv.sphere_map(pyvista.PolyData.from_regular_faces(ball, faces)).xyz  # which keeps doubles
    assert np.allclose(found, expected, atol=1e-6)


@pytest.mark.parametrize("seed", range(20))
def test_padded_lists_of_polygons_are_read(seed: int) -> None:
    """Corners are small numbers, which look like numbers of corners themselves."""
    random = np.random.default_rng(seed)
    rows = [random.integers(0, 9, size).tolist() for size in random.integers(3, 8, random.integers(1, 60))]
    mesh = SimpleNamespace(points=np.zeros((9, 3)), faces=padded(rows))
    assert corner_lists(polygons_of(mesh, None)[1]) == rows


def test_polygons_of_several_sizes_are_unwrapped() -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0.5, 0]], dtype=float)
    rows = [[0, 1, 2, 3], [1, 4, 2]]
    expected = cuv.unwrap(points, rows).uv
    blocks = {"line": np.zeros((2, 2), int), "quad": np.array(rows[:1]), "triangle": np.array(rows[1:])}
    assert np.array_equal(cuv.unwrap(SimpleNamespace(points=points, faces=padded(rows))).uv, expected)
    assert np.array_equal(cuv.unwrap(SimpleNamespace(points=points, cells_dict=blocks)).uv, expected)
    assert np.array_equal(cuv.unwrap((points, rows)).uv, expected)
    for mesh in (
        SimpleNamespace(points=points, cells_dict=blocks),
        SimpleNamespace(points=points, faces=padded(rows)),
        SimpleNamespace(points=points, faces=padded(rows[:1])),
    ):
        with pytest.raises(cuv.MeshError, match=r"no triangles; unwrap\(\) takes them"):
            cuv.disk_map(mesh)


@pytest.mark.parametrize(
    ("mesh", "told"),
    [
        (V, "F is missing"),
        (object(), "A object is no mesh that is known; pass V and F, or a pair"),
        ("scan.obj", "A str is no mesh"),
        (SimpleNamespace(points=V, cells_dict={"tetra": np.zeros((1, 4), int)}), "no polygons but cells tetra"),
        (SimpleNamespace(points=V, faces=np.array([3, 0, 1, 2, 4, 0])), "no list of numbers of corners"),
        (SimpleNamespace(points=V, faces=np.array([3, 0, 1, 2, 0])), "fewer than 3 corners|no triangles"),
        (SimpleNamespace(points=V, faces=np.empty(0, int)), "no faces"),
        (SimpleNamespace(points=V, faces=np.empty(0, int), n_strips=2), "2 triangle strips"),
        (None, "A NoneType is no mesh"),
    ],
)
def test_what_is_no_mesh_is_told(mesh, told: str) -> None:
    for door in (cuv.disk_map, cuv.unwrap):
        with pytest.raises(cuv.MeshError, match=told):
            door(mesh)


def test_both_arguments_are_left_alone() -> None:
    pair = object(), object()
    assert triangles_of(*pair) == pair and polygons_of(*pair) == pair


def test_many_polygons_are_told_apart_quickly() -> None:
    sizes = np.random.default_rng(0).integers(3, 5, 200_000)
    flat = np.zeros(int((sizes + 1).sum()), dtype=np.int64)
    begins = np.concatenate(([0], np.cumsum(sizes + 1)[:-1]))
    flat[begins] = sizes
    _, found = polygons_of(SimpleNamespace(points=np.zeros((1, 3)), faces=flat), None)
    assert np.array_equal(found.sizes, sizes)
