"""Our files in other programs' readers: vertices, faces, and the texture coordinates of every corner."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import conformal_uv as cuv
from conformal_uv.files import MeshFile, read_mesh, write_mesh
from conformal_uv.mesh.polygons import PolygonMesh
from conformal_uv.samples import mask

Corners = np.ndarray  # (m, 3, 5): position and texture coordinates of each triangle's corners


@pytest.fixture(scope="module")
def charts() -> tuple[MeshFile, np.ndarray, Corners]:
    """A mask cut along its middle: two charts, vertices on the seam with two texture coordinates each."""
    V, F = mask(400)
    V = V.astype(np.float32).astype(np.float64)  # what every reader can hold
    F = F[np.random.default_rng(0).permutation(len(F))].astype(np.int64)
    right = V[F, 0].mean(axis=1) > 0
    edges = np.sort(np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1)
    side = np.tile(right, 3)
    keys, inverse = np.unique(edges, axis=0, return_inverse=True)
    both = np.bincount(inverse.reshape(-1), side) * np.bincount(inverse.reshape(-1), ~side)
    u = cuv.unwrap(V, F, seams=keys[both > 0], method="linear")
    assert len(u.charts) == 2
    mesh = PolygonMesh(V, F.reshape(-1), np.arange(0, 3 * len(F) + 1, 3))
    corners = np.concatenate([V[F], u.uv.reshape(-1, 3, 2)], axis=2)
    return MeshFile(Path("memory"), mesh), u.uv, corners


def by_trimesh(path: Path) -> Corners:
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.load_mesh(path, process=False)
    return np.concatenate([mesh.vertices[mesh.faces], mesh.visual.uv[mesh.faces]], axis=2)


def by_meshio(path: Path) -> Corners:
    meshio = pytest.importorskip("meshio")
    mesh = meshio.read(path)
    names = ("s", "t") if path.suffix == ".ply" else None
    uv = mesh.point_data["obj:vt"] if names is None else np.column_stack([mesh.point_data[name] for name in names])
    F = mesh.cells_dict["triangle"]
    return np.concatenate([mesh.points[F], uv[F]], axis=2)


def by_open3d(path: Path) -> Corners:
    open3d = pytest.importorskip("open3d")
    if path.suffix == ".ply":
        pytest.skip("open3d reads no texture coordinates from PLY")
    mesh = open3d.io.read_triangle_mesh(str(path))
    V, F = np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    return np.concatenate([V[F], np.asarray(mesh.triangle_uvs).reshape(-1, 3, 2)], axis=2)


def by_pymeshlab(path: Path) -> Corners:
    pymeshlab = pytest.importorskip("pymeshlab")
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(path))
    mesh = ms.current_mesh()
    F = mesh.face_matrix()
    if mesh.has_wedge_tex_coord():
        uv = mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
    else:
        uv = mesh.vertex_tex_coord_matrix()[F]
    return np.concatenate([mesh.vertex_matrix()[F], uv], axis=2)


BLENDER = """
import sys, bpy, numpy as np
bpy.ops.wm.read_factory_settings(use_empty=True)
path, out = sys.argv[1:]
if path.endswith(".ply"):
    bpy.ops.wm.ply_import(filepath=path)
else:
    bpy.ops.wm.obj_import(filepath=path, forward_axis="Y", up_axis="Z")
mesh = bpy.context.selected_objects[0].data
V = np.array([v.co for v in mesh.vertices])
F = np.array([p.vertices for p in mesh.polygons])
uv = np.array([u.vector for u in mesh.uv_layers.active.uv]).reshape(-1, 3, 2)
np.save(out, np.concatenate([V[F], uv], axis=2))
"""


def by_blender(path: Path) -> Corners:
    if importlib.util.find_spec("bpy") is None:
        pytest.skip("bpy is not installed")
    out = path.with_suffix(".npy")
    subprocess.run([sys.executable, "-c", BLENDER, str(path), str(out)], check=True, capture_output=True)
    return np.load(out)


def by_ourselves(path: Path) -> Corners:
    file = read_mesh(path)
    assert file.corner_uv is not None
    corners = np.concatenate([file.mesh.V[file.mesh.corners], file.corner_uv], axis=1)
    return corners.reshape(-1, 3, 5)


def sorted_corners(corners: Corners) -> np.ndarray:
    """Independent of the order of the faces and of where each begins."""
    rounded = np.round(corners, 5) + 0.0
    turned = [np.roll(rounded, k, axis=1).reshape(len(rounded), -1) for k in range(3)]
    first = np.array([max(range(3), key=lambda k: tuple(turned[k][i])) for i in range(len(rounded))])
    rows = np.stack(turned)[first, np.arange(len(rounded))]
    return rows[np.lexsort(rows.T)]


READERS: list[Callable[[Path], Corners]] = [by_ourselves, by_trimesh, by_meshio, by_open3d, by_pymeshlab, by_blender]


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("suffix", [".ply", ".obj"])
def test_split_files_are_read_alike_by_all(
    charts: tuple[MeshFile, np.ndarray, Corners], tmp_path: Path, reader: Callable[[Path], Corners], suffix: str
) -> None:
    """Positions and UVs to the single precision in which most of them keep both (rounded at 1e-5)."""
    source, uv, corners = charts
    path = tmp_path / f"a{suffix}"
    write_mesh(path, source, corner_uv=uv, split=True)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = reader(path)
    assert np.abs(sorted_corners(found) - sorted_corners(corners)).max() <= 2e-5


@pytest.mark.parametrize("reader", [by_ourselves, by_trimesh, by_open3d, by_pymeshlab, by_blender])
def test_whole_obj_files_are_read_by_those_that_know_corners(
    charts: tuple[MeshFile, np.ndarray, Corners], tmp_path: Path, reader: Callable[[Path], Corners]
) -> None:
    source, uv, corners = charts
    path = tmp_path / "a.obj"
    write_mesh(path, source, corner_uv=uv)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = reader(path)
    assert np.abs(sorted_corners(found) - sorted_corners(corners)).max() <= 2e-5


@pytest.mark.parametrize("reader", ["trimesh", "meshio"])
def test_a_mesh_without_uvs_has_no_empty_lists(tmp_path: Path, reader: str) -> None:
    library = pytest.importorskip(reader)
    V, F = mask(200)
    corners = F.reshape(-1).astype(np.int64)
    path = tmp_path / "a.ply"
    mesh = PolygonMesh(V, corners, np.arange(0, len(corners) + 1, 3))
    write_mesh(path, MeshFile(path, mesh), corner_uv=np.full((len(corners), 2), np.nan))
    assert b"texcoord" not in path.read_bytes().partition(b"end_header")[0]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = (
            library.load_mesh(path, process=False).faces
            if reader == "trimesh"
            else (library.read(path).cells_dict["triangle"])
        )
    np.testing.assert_array_equal(found, F)
