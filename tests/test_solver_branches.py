"""Branches of solvers, Laplacians and geometry that ordinary meshes seldom take, each against what it is to do."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest
from meshes import plate, scattered_disk
from numpy.typing import NDArray

from conformal_uv.linear.backends import choose_backend, linear_solver
from conformal_uv.linear.linear_system import LowerTriangle
from conformal_uv.mesh import Surface
from conformal_uv.mesh.arrays import on_one_line
from conformal_uv.mesh.large_polygons import _clean_ears, cut_large_polygon
from conformal_uv.mesh.polygons import PolygonMesh
from conformal_uv.mesh.triangulate import _ear_quality, triangulate
from conformal_uv.operators.edge_laplacian import LEAST, _sorted
from conformal_uv.operators.mean_value import (
    LEAST_RATIO,
    NeighbourMeans,
    positive_mean_value_matrix,
    surface_mean_value_matrix,
)
from conformal_uv.operators.mollification import ROOM, mollified
from conformal_uv.operators.orientation_sign import orientation_signs, outward_signs
from conformal_uv.optimize import line_search, log_fraction

EPS = np.finfo(np.float64).eps


class Place(NamedTuple):
    """An iterate of a line search."""

    value: float


@pytest.mark.parametrize(("falls", "taken"), [(True, 1.0), (False, None)])
def test_a_decrease_within_the_noise_counts_where_the_gradient_falls_only(falls: bool, taken: float | None) -> None:
    """One unit in the last place, with a slope so small that any decrease is enough."""
    found = line_search(1.0, -1e-20, lambda t: Place(1.0 - 1e-16), lambda there: falls, length=1.0, noise=1e-12)
    assert (found and found[0]) == taken


def test_progress_is_the_part_of_the_way_of_the_logarithm() -> None:
    told = [log_fraction(norm, 1e2, 1e-8) for norm in (1e3, 1e2, 1e-3, 1e-8, 0.0)]
    assert told == pytest.approx([0.0, 0.0, 0.5, 1.0, 1.0])
    assert log_fraction(1.0, 0.0, 1e-8) == 1.0


@pytest.mark.parametrize("backend", ["cholmod", "superlu", "multigrid"])
def test_solutions_that_are_0_in_places(backend: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a matrix in blocks, one of which the right-hand side does not reach; CHOLMOD leaves such entries out."""
    pytest.importorskip({"cholmod": "cvxopt", "superlu": "scipy", "multigrid": "pyamg"}[backend])
    monkeypatch.setattr("conformal_uv.linear.cholesky.MANY", 0)
    whole = np.array([[2.0, -1, 0, 0], [-1, 2.0, 0, 0], [0, 0, 3.0, -1], [0, 0, -1, 3.0]])
    lower = LowerTriangle(
        np.array([2.0, -1, 2, 3, -1, 3]), np.array([0, 1, 1, 2, 3, 3], np.int32), np.array([0, 2, 3, 5, 6])
    )
    rhs = np.zeros((4, 2))
    rhs[0], rhs[3, 1] = [1.0, -2.0], 5.0
    found = linear_solver(lower, backend).solve_at(np.array([0, 3]), rhs[[0, 3]])
    np.testing.assert_allclose(whole @ found, rhs, atol=1e-11)


@pytest.mark.parametrize("name", ["SuperLU", " superlu\n", "SUPERLU"])
def test_the_environment_names_a_backend_as_people_write_it(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CONFORMAL_UV_BACKEND", name)
    assert choose_backend() == "superlu"


def test_edges_between_the_same_two_vertices_add_up() -> None:
    """As in an intrinsic triangulation; the Dirichlet energy is that of all of them."""
    lo, hi = np.array([1, 0, 0, 1, 0], np.int32), np.array([2, 1, 2, 2, 1], np.int32)
    weights = np.array([1.0, 2.0, 4.0, 8.0, 16.0])
    found = _sorted(lo, hi, weights, 3, np.array([[0, 1], [1, 0], [2, 2]], np.int32))
    assert (found.lo.tolist(), found.hi.tolist(), found.weights.tolist()) == ([0, 0, 1], [1, 2, 2], [18.0, 4.0, 9.0])
    z = np.array([0.3, 1.0 + 2.0j, -1.0j])
    assert found.energy(z) == pytest.approx(0.5 * (weights * np.abs(z[lo] - z[hi]) ** 2).sum(), rel=1e-15)


def test_a_vertex_whose_weights_are_all_lost_is_held_by_a_little() -> None:
    """Else it would float, and its row be 0; edges between other vertices keep what they have."""
    lo, hi = np.array([0, 0, 1, 1, 2], np.int32), np.array([1, 2, 2, 3, 3], np.int32)
    found = _sorted(lo, hi, np.array([1.0, 0.0, 2.0, 0.0, 0.0]), 4, np.array([[0, 1], [1, 3], [2, 2]], np.int32))
    assert found.weights.tolist() == [1.0, 0.0, 2.0, LEAST, LEAST]


def test_a_triangle_too_small_for_the_others_is_given_room_by_their_size() -> None:
    """The room is a part of the mean edge: weights of a triangle far below it would drown all others."""
    lengths = np.array([[1.0, 1.0, 1e-14], [1.0, 1.0, 1e-14], [1.0, 1.0, 1e-14]])
    found = mollified(lengths)
    spare = found.sum(axis=0) - 2.0 * found.max(axis=0)
    assert spare.min() >= ROOM * lengths.mean() * (1.0 - 1e-3)
    assert np.ptp(found - lengths) < 1e-15  # every length by the one amount


@pytest.mark.parametrize("folded", [False, True])
def test_an_edge_of_a_folded_corner_counts_as_no_shorter_than_a_part_of_both(folded: bool) -> None:
    """Else the vertex at its other end would hold it where it is, however the patch around them moves."""
    short = 1e-6
    z = np.array([0.0, 1.0, short * np.exp(1.0j)])
    corners = np.arange(3, dtype=np.int32)[:, None]
    W = positive_mean_value_matrix(z, corners, np.array([0]), np.full(3, folded))
    reach = LEAST_RATIO * (1.0 + short) if folded else short
    assert W[0, 2] / W[0, 1] == pytest.approx(1.0 / reach, rel=1e-6)
    assert W[0, 1] == pytest.approx(np.tan(0.5), rel=1e-9)  # of the angle of 1 radian, over the length 1


def test_no_ear_is_cut_over_another_corner_however_many_are_nearer() -> None:
    """Sixteen corners beside a flat ear are nearer to its middle than the one inside it."""
    spikes = np.linspace(1.0, -1.0, 16)
    top = [(9.0, 100.0)]
    for x in spikes:
        top += [(x, 0.05), (x - 0.01, 100.0)]
    P = np.array([(-10.0, 0.0), (0.0, -1.0), (10.0, 0.0), *top, (-7.9, 100.0), (-8.0, -0.1), (-9.0, 100.0)])
    ring = np.arange(len(P))
    tips = _clean_ears(P, ring)
    assert len(tips)
    for tip in tips.tolist():
        T = P[[tip - 1, tip, (tip + 1) % len(P)]]
        side = np.roll(T, -1, axis=0) - T
        height = [side[k, 0] * (P[:, 1] - T[k, 1]) - side[k, 1] * (P[:, 0] - T[k, 0]) for k in range(3)]
        assert np.flatnonzero(np.min(height, axis=0) >= 0.0).tolist() == sorted(
            [(tip - 1) % len(P), tip, (tip + 1) % len(P)]
        )


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_points_of_a_coordinate_plane_lie_on_no_line(axis: int) -> None:
    """Seen along two of the three axes they do."""
    V = np.insert(np.random.default_rng(0).uniform(0.1, 0.9, (200, 2)), axis, 0.5, axis=1)
    assert not on_one_line(V)
    assert on_one_line(np.where(np.arange(3) == axis, 0.5, V[:, [axis - 1]]))


def test_only_corners_that_are_left_can_lie_in_an_ear() -> None:
    """A corner that was cut before is none of the polygon's any more."""
    P = np.array([[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.6, 0.4]]])
    ear = np.array([[0, 1, 2]])
    covering, clean = (_ear_quality(P, np.array([[True, True, True, left]]), ear)[0] for left in (True, False))
    assert covering < 0.0 and clean == pytest.approx(2.0 + np.sin(np.radians(45.0)))


def test_signs_of_triangles_with_equal_coordinates_are_exact() -> None:
    """Corners one unit in the last place apart and of one height, seen from far: rounded, the area is 0."""
    uv = np.array([[1.0, 0.25], [1.0 + EPS, 0.25], [1e3, 0.75], [1e3, -0.75]])
    corners = np.array([[0, 1, 2], [0, 1, 3], [1, 0, 2], [0, 0, 2]], dtype=np.int32).T
    assert orientation_signs(uv, np.ascontiguousarray(corners)).tolist() == [1, -1, -1, 0]
    lifted = np.column_stack((uv, np.ones(4)))  # seen from above, as from the origin
    assert outward_signs(lifted, np.ascontiguousarray(corners)).tolist() == [1, -1, -1, 0]


def test_the_tip_of_a_cap_is_in_the_middle_of_its_loop() -> None:
    V, F = plate(5, 4, ((1, 1, 2, 1),))
    surface = Surface.from_arrays(V, F)
    capped = surface.capped()
    assert capped.n == surface.n + 2 and not capped.loops and capped.genus == 0
    for tip, loop in zip(capped.V[surface.n :], surface.loops, strict=True):
        np.testing.assert_allclose(tip, surface.V[loop].mean(axis=0), rtol=1e-15)


def test_a_flat_surface_is_the_mean_of_its_neighbours_by_its_mean_values() -> None:
    """Whatever its triangles: mean value coordinates reproduce linear functions (Floater 2003)."""
    V, F = scattered_disk(60, 20, seed=1)
    surface = Surface.from_arrays(V, F)
    inside = np.setdiff1d(np.arange(len(V)), surface.loops[0])
    z = V[:, :2] @ [1.0, 1.0j]
    given = z.copy()
    given[inside] = 0.0
    found = NeighbourMeans(surface_mean_value_matrix(surface), inside).placed(given)
    np.testing.assert_allclose(found, z, atol=1e-12)


def signed_areas(P: NDArray[np.float64], F: NDArray[np.int64]) -> NDArray[np.float64]:
    a, b, c = (P[corner] for corner in F.T)
    return 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])


def test_no_ear_of_a_large_polygon_is_cut_along_a_corner() -> None:
    """Teeth whose tips lie exactly on the diagonals of ears: what is left would have no triangulation with areas."""
    x = np.arange(201.0)
    odd = np.arange(201) % 2 == 1
    low, high = np.column_stack((x, np.where(odd, -1.0, 0.0))), np.column_stack((x, np.where(odd, 0.0, 3.0)))
    P = np.concatenate((low, high[::-1]))
    F = cut_large_polygon(P)
    assert F is not None
    areas = signed_areas(P, F)
    assert areas.min() > 0.1 and areas.sum() == pytest.approx(400.0)


def test_an_ear_is_not_cut_where_it_would_leave_a_sliver() -> None:
    """A tip one part in 10^9 beside the diagonal of the ear with the best angles."""
    P = np.array([(-2, 0), (0, -2), (2, 0), (2, 3), (0.5, 3), (0, 1e-9), (-0.5, 3), (-2, 3.0)])
    mesh = PolygonMesh(np.column_stack((P, np.zeros(8))), np.arange(8), np.array([0, 8]))
    areas = signed_areas(P, triangulate(mesh)[0])
    assert areas.min() > 1.0 and areas.sum() == pytest.approx(14.5)
