"""Every refusal of a mesh, each on a mesh broken in exactly that way, and the forms of input that are taken.

The indices expected are read off the builders in meshes.py by hand.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import meshes
import numpy as np
import pytest

import conformal_uv as cuv
from conformal_uv.mesh import Surface

V33, F33 = meshes.plate(3, 3)  # 16 vertices, 18 faces; 5, 6, 9, 10 are interior; face 4 is (5, 6, 10)


class Case(NamedTuple):
    """A broken mesh, the error it must raise, the indices in it and words of its message."""

    name: str
    mesh: Callable[[], tuple[object, object]]
    error: type[cuv.MeshError]
    indices: tuple[int, ...]
    words: tuple[str, ...]


def moved(*changes: tuple[int, int, float]) -> np.ndarray:
    """The plate's vertices with single coordinates changed."""
    V = V33.copy()
    for vertex, axis, value in changes:
        V[vertex, axis] = value
    return V


def plus(*faces: object) -> np.ndarray:
    """The plate's faces and more."""
    return np.concatenate((F33, np.array(faces)))


def flipped(*numbers: int) -> np.ndarray:
    """The plate's faces, some reversed."""
    F = F33.copy()
    F[list(numbers)] = F[list(numbers), ::-1]
    return F


def merged_positions(a: int, b: int) -> np.ndarray:
    """The plate's vertices, b lying where a lies."""
    V = V33.copy()
    V[b] = V[a]
    return V


def with_index(value: object, dtype: object) -> np.ndarray:
    """The plate's faces, an entry of face 2 replaced."""
    F = F33.astype(dtype)
    F[2, 1] = value
    return F


def punctured_torus() -> tuple[np.ndarray, np.ndarray]:
    """A torus without one face: a disk with a handle."""
    V, F = meshes.torus()
    return V, F[1:]


ARRAYS = [
    Case("V one row", lambda: ([0.0, 1.0, 2.0], F33), cuv.MeshError, (), ("V has shape (3,)", "(n, 3)")),
    Case("V four columns", lambda: (np.ones((16, 4)), F33), cuv.MeshError, (), ("V has shape (16, 4)",)),
    Case("V one column", lambda: (np.ones((16, 1)), F33), cuv.MeshError, (), ("V has shape (16, 1)",)),
    Case("V three axes", lambda: (V33[None], F33), cuv.MeshError, (), ("V has shape (1, 16, 3)",)),
    Case("V complex", lambda: (V33 + 0j, F33), cuv.MeshError, (), ("V is not", "complex numbers")),
    Case("V words", lambda: ([["a", "b", "c"]] * 16, F33), cuv.MeshError, (), ("V is not an array of numbers",)),
    Case("V ragged", lambda: ([[0, 0, 0], [1, 0]], F33), cuv.MeshError, (), ("V is not an array of numbers",)),
    Case("V objects", lambda: ([[{}] * 3] * 16, F33), cuv.MeshError, (), ("V is not an array of numbers",)),
    Case("NaN", lambda: (moved((6, 1, np.nan)), F33), cuv.NonFiniteError, (6,), ("1 of 16 vertices", "NaN", ": 6.")),
    Case(
        "infinite",
        lambda: (moved((3, 0, np.inf), (9, 2, np.inf)), F33),
        cuv.NonFiniteError,
        (3, 9),
        ("2 of 16 vertices", "infinite coordinate: 3, 9"),
    ),
    Case("minus inf", lambda: (moved((15, 2, -np.inf)), F33), cuv.NonFiniteError, (15,), ("infinite coordinate: 15",)),
    Case("F one row", lambda: (V33, [0, 1, 2]), cuv.MeshError, (), ("F has shape (3,)", "(m, 3)")),
    Case("F edges", lambda: (V33, F33[:, :2]), cuv.MeshError, (), ("F has shape (18, 2)",)),
    Case("F quads", lambda: (V33, [[0, 1, 5, 4]]), cuv.MeshError, (), ("F has shape (1, 4)", "Polygons", "unwrap()")),
    Case("F ragged", lambda: (V33, [[0, 1, 2], [1, 2]]), cuv.MeshError, (), ("F is not an array",)),
    Case("F fractions", lambda: (V33, F33 + 0.5), cuv.MeshError, (), ("F holds float64, not integers",)),
    Case("F NaN", lambda: (V33, with_index(np.nan, float)), cuv.MeshError, (), ("F holds float64",)),
    Case("F huge floats", lambda: (V33, with_index(1e300, float)), cuv.MeshError, (), ("F holds float64",)),
    Case("F words", lambda: (V33, F33.astype(str)), cuv.MeshError, (), ("F holds <U", "not integers")),
    Case("F complex", lambda: (V33, F33 + 0j), cuv.MeshError, (), ("F holds complex128",)),
    Case("F booleans", lambda: (V33, F33 > 3), cuv.MeshError, (), ("F holds bool",)),
    Case("F missing", lambda: (V33, None), cuv.MeshError, (), ("F is missing",)),
    Case("F objects", lambda: (V33, [[None] * 3]), cuv.MeshError, (), ("F holds object",)),
    Case("negative", lambda: (V33, with_index(-1, int)), cuv.MeshError, (2,), ("outside 0 .. 15", "faces 2")),
    Case("too large", lambda: (V33, with_index(16, int)), cuv.MeshError, (2,), ("outside 0 .. 15",)),
    Case("past int64", lambda: (V33, with_index(2**63 + 5, np.uint64)), cuv.MeshError, (2,), ("outside 0 .. 15",)),
    Case("1-based", lambda: (V33, F33 + 1), cuv.MeshError, (8, 17), ("outside 0 .. 15", "Indices start at 0")),
    Case("no faces", lambda: (V33, np.empty((0, 3), int)), cuv.MeshError, (), ("empty (16 vertices, 0 faces)",)),
    Case("nothing", lambda: (np.empty((0, 3)), np.empty((0, 3), int)), cuv.MeshError, (), ("empty (0 vertices",)),
    Case("no vertices", lambda: (np.empty((0, 3)), F33), cuv.MeshError, (), ("empty (0 vertices, 18 faces)",)),
]

FACES = [
    Case("repeated vertex", lambda: (V33, plus([5, 6, 5])), cuv.DegenerateFaceError, (18,), ("repeat a", "faces 18")),
    Case(
        "coincident vertices",
        lambda: (merged_positions(5, 6), F33),
        cuv.DegenerateFaceError,
        (4, 10),  # at the edge (5, 6): (5, 6, 10) and (1, 6, 5)
        ("2 faces have no area", "faces 4, 10"),
    ),
    Case(
        "collinear",
        lambda: (np.array([[0.1, 0.1, 0.1], [0.3, 0.3, 0.3], [0.7, 0.7, 0.7]]), [[0, 1, 2]]),
        cuv.DegenerateFaceError,
        (0,),
        ("no area",),
    ),
    Case(
        "height below rounding",
        lambda: ([[0, 0, 0], [1, 0, 0], [0.5, 1e-17, 0]], [[0, 1, 2]]),
        cuv.DegenerateFaceError,
        (0,),
        ("no area",),
    ),
    Case("all in one point", lambda: (0.0 * V33, F33), cuv.DegenerateFaceError, tuple(range(18)), ("(18 in all)",)),
    Case("face twice", lambda: (V33, plus(F33[4])), cuv.DuplicateFaceError, (4, 18), ("2 faces", "same three")),
    Case(
        "face twice, turned", lambda: (V33, plus(F33[4][[1, 2, 0]])), cuv.DuplicateFaceError, (4, 18), ("faces 4, 18",)
    ),
    Case("face and its reverse", lambda: (V33, plus(F33[4][::-1])), cuv.DuplicateFaceError, (4, 18), ("Keep one",)),
    Case(
        "a face and its reverse alone",
        lambda: (np.eye(3), [[0, 1, 2], [2, 1, 0]]),
        cuv.DuplicateFaceError,
        (0, 1),
        ("same three vertices",),
    ),
    Case(
        "edge of three faces",
        lambda: (np.concatenate((V33, [[1.5, 1.5, 2.0]])), plus([5, 6, 16])),
        cuv.NonManifoldError,
        (4, 10, 18),
        ("1 edges have three or more faces", "(5, 6)", "faces 4, 10, 18"),
    ),
    Case(
        "bow tie on the boundary",
        lambda: meshes.glued(meshes.plate(2, 2), meshes.plate(2, 2), [(8, 0)]),
        cuv.NonManifoldError,
        (8,),
        ("touch only there", "vertices 8"),
    ),
    Case(
        "tetrahedron on an interior vertex",
        lambda: meshes.glued((V33, F33), meshes.tetrahedron(), [(6, 0)]),
        cuv.NonManifoldError,
        (6,),
        ("join pieces that touch only there", "vertices 6", "every fan"),
    ),
    Case(
        "sphere on two interior vertices",  # Euler number 1 + 2 - 2: that of a disk, with one loop
        lambda: meshes.glued(meshes.plate(6, 5), meshes.octahedron(), [(9, 0), (25, 1)]),
        cuv.NonManifoldError,
        (9, 25),
        ("2 vertices", "touch only there"),
    ),
    Case(
        "sphere on a boundary vertex",
        lambda: meshes.glued((V33, F33), meshes.octahedron(), [(2, 3)]),
        cuv.NonManifoldError,
        (2,),
        ("touch only there",),
    ),
    Case(
        "two interior vertices made one",  # connected through faces all the same
        lambda: meshes.identified(meshes.plate(8, 5), [(10, 34)]),
        cuv.NonManifoldError,
        (10,),
        ("touch only there",),
    ),
    Case("one face reversed", lambda: (V33, flipped(4)), cuv.OrientationError, (4,), ("1 faces", "against", "faces 4")),
    Case("two faces reversed", lambda: (V33, flipped(0, 13)), cuv.OrientationError, (0, 13), ("Reverse",)),
    Case("Moebius band", lambda: meshes.moebius_band(7), cuv.OrientationError, tuple(range(14)), ("one side", "Cut")),
    Case(
        "loose vertices",
        lambda: (np.concatenate((V33[:2], [[9.0, 9, 9]], V33[2:], [[8.0, 8, 8]])), np.where(F33 >= 2, F33 + 1, F33)),
        cuv.UnreferencedVertexError,
        (2, 17),
        ("2 of 18 vertices belong to no face", "vertices 2, 17"),
    ),
]

TYPES = [
    Case(
        "two disks",
        lambda: meshes.disjoint((V33, F33), meshes.wheel(5)),
        cuv.DisconnectedError,
        (),
        ("2 pieces", "unwrap()"),
    ),
    Case(
        "disk and sphere",  # one loop
        lambda: meshes.disjoint((V33, F33), meshes.octahedron()),
        cuv.DisconnectedError,
        (),
        ("2 pieces",),
    ),
    Case("sphere", meshes.icosahedron, cuv.TopologyError, (), ("closed", "genus 0", "Use sphere_map()")),
    Case("torus", meshes.torus, cuv.TopologyError, (), ("closed", "genus 1", "handles")),
    Case(
        "annulus",
        lambda: meshes.annulus(8),
        cuv.TopologyError,
        (8, 1),  # face 0 is (0, 8, 9): edge (8, 9) leads the outer loop; face 8, (0, 9, 1), has (1, 0) on the inner
        ("2 boundary loops (8 edges, 8 edges)", "genus 0", "Fill the holes"),
    ),
    Case(
        "plate with two holes",
        lambda: meshes.plate(7, 5, ((1, 1, 2, 3), (5, 2, 1, 1))),
        cuv.TopologyError,
        (0, 9, 20),  # each hole's first half-edge is the right side of the quad left of it, begun at its lower end
        ("3 boundary loops (24 edges, 10 edges, 4 edges)", "genus 0"),
    ),
    Case("disk with a handle", punctured_torus, cuv.TopologyError, (), ("one boundary loop but genus 1", "no handles")),
]


@pytest.mark.parametrize("case", ARRAYS + FACES + TYPES, ids=lambda case: case.name)
def test_broken_mesh_is_refused(case: Case) -> None:
    V, F = case.mesh()
    with pytest.raises(cuv.MeshError) as caught:
        cuv.disk_map(V, F, laplacian="cotan")  # "auto" mollifies faces without area
    assert type(caught.value) is case.error
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, cuv.ConformalUVError)
    for word in case.words:
        assert word in str(caught.value)
    assert caught.value.indices == case.indices


def test_hint_at_1_based_indices_only_where_they_are() -> None:
    with pytest.raises(cuv.MeshError, match=r"outside 0 \.\. 15: faces 2\.$"):
        cuv.disk_map(V33, with_index(16, int))


def test_long_index_lists_are_cut_in_the_text_and_whole_in_indices() -> None:
    V, F = meshes.plate(9, 9)
    V[20:40] = np.nan
    with pytest.raises(cuv.NonFiniteError, match=r"20, 21, 22, 23, 24, 25, 26, 27, \.\.\. \(20 in all\)") as caught:
        cuv.disk_map(V, F)
    assert caught.value.indices == tuple(range(20, 40))


V_EXACT = np.round(V33 * 2.0**12) / 2.0**12  # coordinates that float32 holds exactly

ACCEPTED = {
    "lists": (V_EXACT.tolist(), F33.tolist()),
    "float32": (V_EXACT.astype(np.float32), F33),
    "Fortran order": (np.asfortranarray(V_EXACT), np.asfortranarray(F33)),
    "slices": (np.repeat(V_EXACT, 2, axis=0)[::2], np.repeat(F33, 3, axis=1)[:, ::3]),
    "wide slice": (np.hstack((V_EXACT, V_EXACT))[:, :3], F33[::-1][::-1]),
    "uint8": (V_EXACT, F33.astype(np.uint8)),
    "uint64": (V_EXACT, F33.astype(np.uint64)),
    "int16": (V_EXACT, F33.astype(np.int16)),
    "big endian": (V_EXACT.astype(">f8"), F33.astype(">i4")),
    "whole floats": (V_EXACT, F33.astype(float)),
}


@pytest.mark.parametrize("form", ACCEPTED)
def test_form_of_input_changes_nothing(form: str) -> None:
    """Oracle: the same numbers as float64 and int64 arrays, bit for bit."""
    expected = cuv.disk_map(V_EXACT, F33)
    assert len(expected.flipped) == 0
    np.testing.assert_array_equal(cuv.disk_map(*ACCEPTED[form]).uv, expected.uv)


def test_two_columns_lie_in_the_plane() -> None:
    V = V33 * [1.0, 1.0, 0.0]
    np.testing.assert_array_equal(cuv.disk_map(V[:, :2], F33).uv, cuv.disk_map(V, F33).uv)


def test_input_arrays_are_left_alone() -> None:
    V, F = V33.copy(), F33.copy()
    V.flags.writeable = F.flags.writeable = False  # writing to them raises
    for method in ("linear", "newton", "augmented-lagrangian"):
        cuv.disk_map(V, F, method=method)
    np.testing.assert_array_equal(V, V33)


SMALL = {
    "one triangle": (np.array([[0.0, 0, 0], [3, 0, 1], [1, 2, 0]]), np.array([[0, 1, 2]])),
    "thin triangle": (np.array([[0.0, 0, 0], [1, 0, 0], [0.5, 1e-12, 0]]), np.array([[0, 1, 2]])),
    "two triangles": meshes.strip(1),
    "strip": meshes.strip(9),
    "fan": meshes.fan(7),
    "wheel of three": meshes.wheel(3),
}


@pytest.mark.parametrize("method", ["linear", "newton"])
@pytest.mark.parametrize("name", SMALL)
def test_smallest_meshes_are_mapped(name: str, method: str) -> None:
    """A Tutte embedding on the circle needs no interior vertex: nothing may flip, whatever the shape."""
    V, F = SMALL[name]
    m = cuv.disk_map(V, F, method=method)
    assert np.isfinite(m.uv).all()
    np.testing.assert_allclose(np.hypot(*m.uv[m.boundary].T), 1.0, rtol=0, atol=1e-12)
    p = m.uv[F]
    area = np.linalg.det(np.stack((p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1))
    assert area.min() > 0.0
    assert len(m.flipped) == 0
    assert np.isfinite([m.conformal_energy, m.dirichlet_energy]).all()


def test_a_thin_face_is_no_face_without_area() -> None:
    """The area of heights down to 8 eps of the length is told from rounding; 1e-17 is refused above."""
    V = SMALL["thin triangle"][0] * [1.0, 1e-2, 1.0]  # 1e-14 high
    assert cuv.disk_map(V, [[0, 1, 2]], laplacian="cotan").laplacian == "cotan"


WITHOUT_AREA = {
    "coincident vertices": merged_positions(5, 6),
    "collinear": np.where(np.arange(16)[:, None] == 6, (V33[5] + V33[10]) / 2.0, V33),
}


@pytest.mark.parametrize("name", WITHOUT_AREA)
def test_faces_without_area_are_mapped_or_refused(name: str) -> None:
    """By default on mollified lengths, where no weight is negative, so nothing may flip; not with cotangents."""
    V = WITHOUT_AREA[name]
    for method in ("linear", "newton"):
        m = cuv.disk_map(V, F33, method=method)
        np.testing.assert_allclose(np.hypot(*m.uv[m.boundary].T), 1.0, rtol=0, atol=1e-12)
        p = m.uv[F33]
        assert np.linalg.det(np.stack((p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)).min() > 0.0
        assert m.laplacian == "intrinsic-delaunay" and len(m.flipped) == 0
    for options in ({"laplacian": "cotan"}, {"method": "augmented-lagrangian"}):
        with pytest.raises(cuv.DegenerateFaceError, match="no area"):
            cuv.disk_map(V, F33, **options)


def shuffled(mesh: tuple[np.ndarray, np.ndarray], seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Vertices renamed, faces in another order and each begun at another corner."""
    V, F = mesh
    rng = np.random.default_rng(seed)
    name = rng.permutation(len(V))
    W = np.empty_like(V)
    W[name] = V
    F = name[F][rng.permutation(len(F))]
    turn = (rng.integers(3, size=len(F))[:, None] + np.arange(3)) % 3
    return W, np.take_along_axis(F, turn, axis=1)


@pytest.mark.parametrize("seed", range(5))
def test_boundary_starts_at_the_first_boundary_half_edge(seed: int) -> None:
    """design.md 3.3: faces read in order, edges (0,1), (1,2), (2,0); oracle: the slow tracer that does just that."""
    V, F = shuffled(meshes.plate(5, 4), seed)
    boundary = cuv.disk_map(V, F, method="linear").boundary
    assert boundary.tolist() == meshes.slow_loops(F)[0]
    x, y = V[boundary, 0], V[boundary, 1]  # faces are anticlockwise seen from above, so is the loop, round 5 x 4
    assert 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) == pytest.approx(20.0, rel=1e-12)


def test_boundary_start_worked_by_hand() -> None:
    """Two triangles: (2, 0, 1) has the inner edge (2, 0) first, so (0, 1) leads; the loop follows the winding."""
    V = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    assert cuv.disk_map(V, [[2, 0, 1], [0, 2, 3]]).boundary.tolist() == [0, 1, 2, 3]
    assert cuv.disk_map(V, [[0, 2, 3], [2, 0, 1]]).boundary.tolist() == [2, 3, 0, 1]


HOLES = ((1, 1, 2, 3), (5, 2, 1, 1), (8, 4, 3, 2), (5, 5, 2, 3), (9, 1, 1, 2))


@pytest.mark.parametrize("seed", range(3))
def test_all_loops_of_a_plate_with_holes(seed: int) -> None:
    """Lengths are the perimeters of 12 x 9 and of the holes; loops against the slow tracer, in its order."""
    V, F = shuffled(meshes.plate(12, 9, HOLES), seed)
    surface = Surface.from_arrays(V, F)
    assert [loop.tolist() for loop in surface.loops] == meshes.slow_loops(F)
    perimeters = [2 * (12 + 9)] + [2 * (width + height) for _, _, width, height in HOLES]
    assert sorted(len(loop) for loop in surface.loops) == sorted(perimeters)
    assert (surface.genus, surface.pieces, surface.euler_characteristic) == (0, 1, 1 - len(HOLES))


def test_genus_and_pieces_of_several_surfaces() -> None:
    """chi = 2 pieces - 2 genus - loops: a torus (0), a sphere (2) and a disk (1) together have 3."""
    V, F = meshes.disjoint(meshes.disjoint(meshes.torus(), meshes.octahedron()), (V33, F33))
    surface = Surface.from_arrays(V, F)
    assert (surface.euler_characteristic, surface.pieces, surface.genus, len(surface.loops)) == (3, 3, 1, 1)
