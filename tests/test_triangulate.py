"""Polygons to triangles: true triangulations, checked by areas that a wrong cut can not give."""

import numpy as np
import pytest

from conformal_uv.errors import MeshError
from conformal_uv.mesh.polygons import PolygonMesh
from conformal_uv.mesh.triangulate import triangulate


def polygons(*outlines):
    """A mesh of separate polygons; plane ones may be given by two coordinates."""
    points = [np.c_[p, np.zeros(len(p))] if np.shape(p)[1] == 2 else np.asarray(p, float) for p in outlines]
    V = np.concatenate(points).astype(float)
    starts = np.concatenate([[0], np.cumsum([len(p) for p in points])])
    return PolygonMesh(V, np.arange(len(V)), starts)


def shoelace(p):
    x, y = np.asarray(p, float).T
    return 0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)


def signed_areas(V, F):
    a, b, c = (V[F[:, k], :2] for k in range(3))
    return 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])


def rotation(seed):
    Q, R = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    Q *= np.sign(np.diag(R))
    return Q * np.linalg.det(Q)


def star(size, seed):
    """A simple polygon: random radii at ascending angles (deep notches)."""
    rng = np.random.default_rng(seed)
    angle = 2 * np.pi * (np.arange(size) + rng.uniform(0, 0.4, size)) / size
    return rng.uniform(0.1, 1, size)[:, None] * np.c_[np.cos(angle), np.sin(angle)]


def spiral(turns, steps):
    """A band wound up on itself."""
    t = np.linspace(0, 2 * np.pi * turns, steps)
    arm = np.c_[np.cos(t), np.sin(t)] * (1 + t)[:, None]
    return np.concatenate([arm, (arm * (1 + 2 / (1 + t))[:, None])[::-1]])[::-1]


COMB = np.array([[0, 0], [7, 0], [7, 5], [6, 1], [5, 5], [4, 1], [3, 5], [2, 1], [1, 5]], float)
CROSS = np.array([[1, 0], [2, 0], [2, 1], [3, 1], [3, 2], [2, 2], [2, 3], [1, 3], [1, 2], [0, 2], [0, 1], [1, 1]])
FLAT_SIDES = np.array([[0, 0], [1, 0], [2, 0], [3, 0], [3, 1], [3, 3], [2, 3], [0, 3], [0, 2], [0, 1]])
KEYHOLE = np.array([[0, 0], [4, 0], [4, 4], [0, 4], [0, 0], [1, 1], [1, 3], [3, 3], [3, 1], [1, 1]])


def check_contract(mesh):
    F, face, corner = triangulate(mesh)
    assert F.dtype == face.dtype == corner.dtype == np.int64
    assert np.array_equal(F, mesh.corners[corner])
    assert np.array_equal(face, np.repeat(np.arange(len(mesh.sizes)), mesh.sizes - 2))
    assert ((corner >= mesh.starts[face, None]) & (corner < mesh.starts[face + 1, None])).all()
    return F, face, corner


def check_exact_cover(F):
    """Every polygon edge once, every diagonal once in each sense: the edges of a triangulation."""
    edges = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]).tolist()
    pairs = {tuple(e) for e in edges}
    assert len(pairs) == len(edges)
    return {e for e in pairs if e[::-1] not in pairs}


def test_triangles_pass_through():
    mesh = PolygonMesh(np.zeros((5, 3)), np.array([4, 1, 2, 0, 3, 1]), np.array([0, 3, 6]))
    F, face, corner = check_contract(mesh)
    assert F.tolist() == [[4, 1, 2], [0, 3, 1]]
    assert face.tolist() == [0, 1]
    assert corner.tolist() == [[0, 1, 2], [3, 4, 5]]


def test_no_faces():
    F, face, corner = triangulate(PolygonMesh(np.zeros((2, 3)), np.zeros(0, np.int64), np.zeros(1, np.int64)))
    assert F.shape == corner.shape == (0, 3) and face.shape == (0,)


def test_mixed_sizes_keep_their_order():
    mesh = polygons(star(5, 0), star(3, 1), star(4, 2), star(6, 3), star(3, 4), star(5, 5))
    F, face, _ = check_contract(mesh)
    areas = np.zeros(6)
    np.add.at(areas, face, signed_areas(mesh.V, F))
    outlines = [mesh.V[a:b, :2] for a, b in zip(mesh.starts[:-1], mesh.starts[1:], strict=True)]
    np.testing.assert_allclose(areas, [shoelace(p) for p in outlines], rtol=1e-13)


@pytest.mark.parametrize("turn", range(4))
def test_concave_quad_is_cut_at_its_notch(turn):
    arrow = np.roll(np.array([[0, 0], [2, -1], [0.5, 0], [2, 1]]), turn, axis=0)
    F, _, _ = check_contract(polygons(arrow))
    assert (signed_areas(polygons(arrow).V, F) > 0.1).all()


@pytest.mark.parametrize("seed", range(3))
def test_convex_quad_takes_the_shorter_diagonal(seed):
    kite = np.array([[0, -1, 0], [3, 0, 0], [0, 1, 0], [-3, 0, 0]]) @ rotation(seed).T
    for turn in range(4):
        outline = np.roll(kite, turn, axis=0)
        F, _, _ = check_contract(polygons(outline))
        lengths = np.linalg.norm(outline[F] - outline[np.roll(F, -1, axis=1)], axis=2)
        assert lengths.max() < 4  # the long diagonal is 6


def test_quad_with_a_flat_corner_keeps_both_areas():
    outline = np.array([[0, 0], [1, 0], [2, 0], [1, 9]], float)
    for turn in range(4):
        mesh = polygons(np.roll(outline, turn, axis=0))
        F, _, _ = check_contract(mesh)
        np.testing.assert_allclose(signed_areas(mesh.V, F), [4.5, 4.5], rtol=1e-14)


SHAPES = {
    "comb": COMB,
    "cross": CROSS,
    "flat sides": FLAT_SIDES,
    "spiral": spiral(3, 40),
    **{f"star {n}": star(n, n) for n in (5, 6, 7, 12, 40, 150)},
}


@pytest.mark.parametrize("name", SHAPES)
def test_simple_polygons_are_truly_triangulated(name):
    outline = np.asarray(SHAPES[name], float)
    assert shoelace(outline) > 0
    mesh = polygons(outline)
    F, _, _ = check_contract(mesh)
    areas = signed_areas(mesh.V, F)
    assert (areas > 0).all()
    np.testing.assert_allclose(areas.sum(), shoelace(outline), rtol=1e-12)
    size = len(outline)
    assert check_exact_cover(F) == {(k, (k + 1) % size) for k in range(size)}


@pytest.mark.parametrize("name", ["comb", "cross", "flat sides", "spiral", "star 40"])
def test_plane_of_the_polygon_does_not_matter(name):
    outline = np.asarray(SHAPES[name], float)
    flat = np.c_[outline, np.zeros(len(outline))]
    Q = rotation(5)
    mesh = polygons(1e-3 * flat @ Q.T + [3, -2, 5])
    F, _, _ = check_contract(mesh)
    areas = signed_areas(flat, F)
    assert (areas > 0).all()
    np.testing.assert_allclose(areas.sum(), shoelace(outline), rtol=1e-12)


def test_clockwise_polygons_keep_their_winding():
    mesh = polygons(COMB[::-1], CROSS[::-1])
    F, _, _ = check_contract(mesh)
    areas = signed_areas(mesh.V, F)
    assert (areas < 0).all()
    np.testing.assert_allclose(areas.sum(), shoelace(COMB[::-1]) + shoelace(CROSS[::-1]), rtol=1e-13)


def test_polygon_with_a_hole_on_a_bridge():
    mesh = polygons(KEYHOLE)
    F, _, _ = check_contract(mesh)
    areas = signed_areas(mesh.V, F)
    assert (areas > 0).all()
    np.testing.assert_allclose(areas.sum(), 12, rtol=1e-14)


@pytest.mark.parametrize("seed", range(10))
def test_first_ear_is_the_one_with_the_widest_smallest_angle(seed):
    t = np.sort(np.random.default_rng(seed).uniform(0, 2 * np.pi, 7))
    outline = np.c_[2 * np.cos(t), np.sin(t)]  # convex: every corner is an ear

    def smallest_angle(k):
        a, b, c = outline[[k - 1, k, (k + 1) % 7]]
        return min(
            np.arccos((q - p) @ (r - p) / np.linalg.norm(q - p) / np.linalg.norm(r - p))
            for p, q, r in ((a, b, c), (b, c, a), (c, a, b))
        )

    best = max(range(7), key=smallest_angle)
    F, _, _ = check_contract(polygons(outline))
    assert F[0].tolist() == [(best - 1) % 7, best, (best + 1) % 7]


@pytest.mark.parametrize(
    "outline",
    [
        np.zeros((6, 2)),
        np.c_[np.arange(7), np.arange(7)],
        np.array([[0, 0], [1, 1], [1, 0], [0, 1], [0.5, 3], [2, 2]]),
        np.full((5, 2), np.nan),
        np.array([[0, 0], [np.inf, 1], [1, 0], [0, 1], [0.5, 3]]),
    ],
    ids=["point", "line", "self-crossing", "nan", "inf"],
)
def test_degenerate_polygons_still_end(outline):
    F, _, _ = check_contract(polygons(outline, COMB))
    first = F[: len(outline) - 2]
    assert (np.sort(first, axis=1)[:, 1:] > np.sort(first, axis=1)[:, :-1]).all()
    assert check_exact_cover(first) == {(k, (k + 1) % len(outline)) for k in range(len(outline))}


def test_many_polygons_side_by_side_as_one_by_one():
    outlines = [star(9, seed) for seed in range(300)]
    F, _, _ = check_contract(polygons(*outlines))
    alone = [triangulate(polygons(p))[0] + 9 * k for k, p in enumerate(outlines)]
    assert np.array_equal(F, np.concatenate(alone))


@pytest.mark.parametrize("sizes", [[3, 2, 3, 1], [3, 0]])
def test_too_few_corners_are_named(sizes):
    starts = np.concatenate([[0], np.cumsum(sizes)])
    mesh = PolygonMesh(np.zeros((9, 3)), np.arange(starts[-1]), starts)
    with pytest.raises(MeshError, match="fewer than 3 corners") as caught:
        triangulate(mesh)
    assert caught.value.indices == tuple(np.flatnonzero(np.array(sizes) < 3))
