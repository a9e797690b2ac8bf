"""What maps with a free boundary stand on: the Dirichlet-to-Neumann map, closing, mirrored parts, crossings."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from conformal_uv import samples
from conformal_uv.errors import SolverError
from conformal_uv.free.conjugate import extended_without_mirrored_part
from conformal_uv.free.polygon import closed_polygon, closing_lengths
from conformal_uv.mesh.surface import Surface
from conformal_uv.operators import boundary_operator, cotangent_laplacian
from conformal_uv.operators.boundary_operator import BoundaryOperator
from conformal_uv.operators.curvature import corner_angles, curvatures
from conformal_uv.operators.dirichlet import DirichletProblem
from conformal_uv.operators.edge_laplacian import cotan_edges
from conformal_uv.operators.polygon_crossings import polygon_crossings
from conformal_uv.progress import Progress

RNG = np.random.default_rng(5)
Complex = NDArray[np.complex128]


def problem(V: NDArray[np.float64], F: NDArray[np.int32]) -> tuple[Surface, DirichletProblem]:
    surface = Surface.from_arrays(V, F)
    laplacian = cotan_edges(surface.edges, surface.geometry)
    return surface, DirichletProblem(laplacian, surface.require_disk(), surface.n)


@pytest.fixture(scope="module")
def mask() -> tuple[Surface, DirichletProblem, NDArray[np.float64]]:
    """A surface and S as a dense matrix."""
    V, F = samples.mask(600)
    surface, found = problem(V, F)
    L, b, i = cotangent_laplacian(V, F).toarray(), found.boundary, found.interior
    return surface, found, L[np.ix_(b, b)] - L[np.ix_(b, i)] @ np.linalg.solve(L[np.ix_(i, i)], L[np.ix_(i, b)])


def test_the_operator_is_the_schur_complement(mask) -> None:
    _, found, S = mask
    x = RNG.normal(size=len(S)) + 1j * RNG.normal(size=len(S))
    flux, interior = BoundaryOperator(found).applied(x)
    np.testing.assert_allclose(flux, S @ x, atol=1e-12)
    np.testing.assert_allclose(interior, found.interior_values(x))


def test_the_operator_is_inverted_in_few_steps(mask, monkeypatch) -> None:
    _, found, S = mask
    x = RNG.normal(size=len(S)) + 1j * RNG.normal(size=len(S))
    x -= x.mean()
    steps: list[float] = []
    progress = Progress(lambda stage, part: steps.append(part))
    solved = BoundaryOperator(found).solved(S @ x + 3.0, 1e-12, progress, "boundary")
    np.testing.assert_allclose(solved, x, atol=1e-9)
    assert len(steps) < 45 and steps == sorted(steps)
    monkeypatch.setattr(boundary_operator, "MOST_STEPS", 3)
    with pytest.raises(SolverError, match="3 steps"):
        BoundaryOperator(found).solved(S @ x, 1e-12, Progress(), "boundary")


def test_the_preconditioner_knows_the_size_of_waves() -> None:
    """On the flat disk S of the wave k is about |k| times the spacing 2 pi / nb."""
    _, found = problem(*samples.flat_disk(4000))
    operator, nb = BoundaryOperator(found), len(found.boundary)
    for k in (1, 2, 5):
        wave = np.exp(2j * np.pi * k * np.arange(nb) / nb)
        smooth = operator.precondition(operator.applied(wave)[0])
        assert np.vdot(wave, smooth) / nb == pytest.approx(1.0, abs=0.02)


def test_curvatures_sum_to_a_full_turn_even_without_areas() -> None:
    V, F = samples.mask(600)
    V = V.copy()
    V[F[100, 0]] = V[F[100, 1]]  # two vertices in one point
    V[F[300, 2]] = 0.5 * (V[F[300, 0]] + V[F[300, 1]])
    surface = Surface.from_arrays(V, F)
    assert len(surface.degenerate) == 2
    np.testing.assert_allclose(corner_angles(surface).sum(axis=0), np.pi)
    assert curvatures(surface, surface.require_disk()).sum() == pytest.approx(2 * np.pi)


def test_polygons_close_by_the_smallest_change() -> None:
    """What differs little from closed changes, to second order, by the weighted least squares of the paper."""
    turning = 2 * np.pi * RNG.dirichlet(np.full(12, 4.0))
    headings = np.concatenate(([0.0], np.cumsum(turning[1:])))
    way = np.stack((np.cos(headings), np.sin(headings)))
    closed = closing_lengths(headings, RNG.uniform(1.0, 2.0, 12))
    assert np.abs(way @ closed).max() < 1e-14 * closed.sum()
    change = []
    for size in (1e-2, 1e-3):
        wanted = closed * (1.0 + size * np.random.default_rng(1).normal(size=12))
        squares = wanted - wanted * (np.linalg.solve((way * wanted) @ way.T, way @ wanted) @ way)
        change.append(np.abs(closing_lengths(headings, wanted) - squares).max())
        assert change[-1] < 10.0 * size**2
    assert change[1] < 0.02 * change[0]


def test_lengths_stay_positive_where_least_squares_do_not() -> None:
    headings = np.radians([0.0, 90.0, 180.0, 270.0])
    lengths = closing_lengths(headings, np.array([1.0, 1.0, 50.0, 1.0]))
    np.testing.assert_allclose(lengths, [np.sqrt(50.0), 1.0, np.sqrt(50.0), 1.0])  # geometric means
    way = np.stack((np.cos(headings), np.sin(headings)))
    wanted = np.array([1.0, 1e-6, 50.0, 1.0])
    assert (closing_lengths(headings, wanted) > 0.0).all()
    assert np.abs(way @ closing_lengths(headings, wanted)).max() < 1e-12


@pytest.mark.parametrize("turning", [[2 * np.pi, 0.0, 0.0], [np.pi, np.pi, 0.0], [0.0, 6.0, 0.28]])
def test_edges_that_head_one_way_do_not_close(turning: list[float]) -> None:
    assert closed_polygon(np.array(turning), np.ones(3)) is None


def test_mirrored_parts_are_taken_out(mask) -> None:
    """A curve with a mirrored part: half a step of the exact inverse, in whatever way the curve is turned."""
    surface, found, S = mask
    nb = len(S)
    t = 2 * np.pi * np.arange(nb) / nb
    zb = np.exp(1j * t) + 0.1 * np.exp(-5j * t)

    def energy(z: Complex) -> float:
        b = z[found.boundary]
        return 0.5 * np.vdot(b, S @ b).real - 0.5 * np.vdot(b, np.roll(b, -1)).imag

    before, after = found.extend(zb), extended_without_mirrored_part(found, zb)
    exact = zb - 0.5 * np.linalg.pinv(S) @ (S @ zb + 0.5j * (np.roll(zb, -1) - np.roll(zb, 1)))
    exact += zb.mean() - exact.mean()
    least = energy(found.extend(exact))
    assert least < 0.2 * energy(before) and energy(after) < least + 0.1 * (energy(before) - least)
    np.testing.assert_allclose(found.interior_values(after[found.boundary]), after[found.interior], atol=1e-12)
    turned = extended_without_mirrored_part(found, np.exp(0.7j) * zb)
    np.testing.assert_allclose(turned, np.exp(0.7j) * after, atol=1e-12)


def test_curves_without_mirrored_part_stay() -> None:
    V, F = samples.flat_disk(2000)
    surface, found = problem(V, F)
    zb = (surface.V[:, :2] @ [1, 1j])[found.boundary]
    for curve in (zb, zb + 0.4 * zb**2):
        np.testing.assert_array_equal(extended_without_mirrored_part(found, curve)[found.boundary], curve)


def slow_crossings(z: Complex) -> list[list[int]]:
    nb, found = len(z), []
    after = np.roll(z, -1)
    for i in range(nb):
        for j in range(i + 2, nb - (i == 0)):
            side = [((after[a] - z[a]).conj() * (p - z[a])).imag for a, b in ((i, j), (j, i)) for p in (z[b], after[b])]
            if side[0] * side[1] < 0 and side[2] * side[3] < 0:
                found.append([i, j])
    return found


@pytest.mark.parametrize("nb", [3, 4, 5, 7, 16, 33, 100])
def test_crossings_of_random_polygons(nb: int) -> None:
    for seed in range(5):
        rng = np.random.default_rng(seed)
        z = rng.normal(size=nb) + 1j * rng.normal(size=nb)
        assert polygon_crossings(z).tolist() == slow_crossings(z)
        smooth = np.cumsum(z - z.mean())
        assert polygon_crossings(smooth).tolist() == slow_crossings(smooth)


def test_crossings_of_curves() -> None:
    t = 2 * np.pi * (np.arange(1000) + 0.5) / 1000
    assert len(polygon_crossings(np.exp(1j * t))) == 0
    assert len(polygon_crossings(np.sin(t) + 1j * np.sin(2 * t))) == 1
    assert len(polygon_crossings(np.exp(2j * t) * (1 + 0.1 * np.cos(t)))) == 1  # twice around
    cut = np.array([0, 1 + 1e-13j, 2 - 0.5j, 3 - 0.5j])  # bent, and its sides the same but for rounding
    slit = np.concatenate((cut[::-1], cut[1:-1].real + 1j * cut[1:-1].imag.round(9), [3 - 0.5j], [3 + 2j, -1 + 2j]))
    assert len(polygon_crossings(np.concatenate((slit, [-1 - 1j, 3 - 1j])))) == 0
    square = np.array([0, 1, 1 + 1j, 1j])
    touching = np.array([0, 3, 3 + 3j, 3j, 0.5 + 1.5j, 2 + 2j, 2 + 1j, 0.5 + 1.5j])  # a ring shut at one point
    assert len(polygon_crossings(touching)) == 0
    assert len(polygon_crossings(np.concatenate((square, square)))) > 0  # twice over itself


def test_crossings_of_long_curves_take_few_comparisons() -> None:
    """Half a million edges: by all pairs that would be 10^11."""
    t = 2 * np.pi * (np.arange(1 << 19) + 0.5) / (1 << 19)
    wavy = np.exp(1j * t) * (1 + 0.1 * np.sin(40 * t))
    assert len(polygon_crossings(wavy)) == 0
