"""Branches of the disk's maps that ordinary meshes seldom take, each against what it is to do."""

from __future__ import annotations

from types import SimpleNamespace

import meshes
import numpy as np
import pytest
from numpy.typing import NDArray

import conformal_uv as cuv
from conformal_uv.disk import auto, centre_cell, mapper, placement
from conformal_uv.disk.boundary_energy import BoundaryEnergy
from conformal_uv.disk.gauge import CentreGauge, PinGauge
from conformal_uv.disk.harmonic_measure import centred_measure
from conformal_uv.disk.newton import NewtonResult, _newton_direction, minimise_boundary_energy
from conformal_uv.disk.placement import CUBE_ROOTS, place_pins
from conformal_uv.disk.preconditioner import FourierPreconditioner, StripPreconditioner
from conformal_uv.disk.repair import _where_better, recentred
from conformal_uv.disk.tangent import Tangent
from conformal_uv.mesh import Surface
from conformal_uv.operators.dirichlet import DirichletProblem
from conformal_uv.operators.edge_laplacian import edge_laplacian
from conformal_uv.operators.moebius import Moebius, centring_step, turned_angles
from conformal_uv.operators.orientation_sign import flipped_faces
from conformal_uv.operators.plane_map import unresolved_faces
from conformal_uv.optimize import Status
from conformal_uv.options import DiskOptions
from conformal_uv.progress import Progress
from conformal_uv.samples import flat_disk, mask

EPS = np.finfo(np.float64).eps


def factorized(V: NDArray, F: NDArray) -> tuple[Surface, DirichletProblem]:
    surface = Surface.from_arrays(V, F)
    laplacian = edge_laplacian(surface.corners, surface.edges, surface.geometry, surface.n)
    return surface, DirichletProblem(laplacian, surface.require_disk(), surface.n)


def test_newtons_direction_takes_the_gradient_away_along_the_constraints() -> None:
    """The derivative of the projected gradient along the curve that keeps the center at 0, by differences.

    For a direction with ``P H d = -P g``, H the Hessian less the constraints' curvature times their multipliers, it is
    minus the projected gradient. Without that curvature, or with its sign reversed, it is not: the angles are far from
    the minimum and the measure from even, so that the multipliers are not small.
    """
    surface, problem = factorized(*mask(300))
    measure = problem.harmonic_measure(int(problem.interior[3]))
    theta = centred_measure(surface, problem).theta
    theta = theta + 0.3 * np.sin(2.0 * theta) + 0.2 * np.cos(theta)
    gauge = CentreGauge(measure, theta)
    here = BoundaryEnergy(problem, gauge.restore(theta), minus_area=True)
    links = np.zeros(len(theta), dtype=bool)
    tangent = Tangent(gauge, here.theta, links, StripPreconditioner(problem, here.theta))
    gradient = tangent.project(here.gradient)
    norm = float(np.linalg.norm(gradient))
    # The tolerance is such that the system is solved to 1e-5 of the gradient.
    direction, _ = _newton_direction(here, gauge, tangent, 2e-5 * norm, lambda: None)
    step = 1e-5
    ahead, behind = (
        BoundaryEnergy(problem, gauge.restore(here.theta + s * direction), minus_area=True) for s in (step, -step)
    )
    change = [
        Tangent(gauge, there.theta, links, StripPreconditioner(problem, here.theta)).project(there.gradient)
        for there in (ahead, behind)
    ]
    slope = tangent.project(change[0] - change[1]) / (2.0 * step)
    assert np.linalg.norm(slope + gradient) < 1e-3 * norm
    multipliers, *_ = np.linalg.lstsq(gauge.normals(here.theta), here.gradient, rcond=None)
    assert np.linalg.norm(multipliers) > norm
    bend = tangent.project(gauge.curvature(here.theta, here.gradient) * direction)
    assert np.linalg.norm(bend) > 1e-2 * norm  # what the test would miss is ten times what it lets pass


def test_newtons_step_on_the_measure_is_of_second_order() -> None:
    """The mean that it leaves of points with a mean of size t is of size t^2 (Baden, Crane, Kazhdan 2018)."""
    theta = 2.0 * np.pi * np.arange(200) / 200
    weights = 1.0 + 0.9 * np.cos(2.0 * theta)  # far from even: the mean of the squares is 0.45
    left = []
    for t in (1e-1, 1e-2, 1e-3):
        shifted = weights + t * np.cos(theta + 0.4)
        shifted /= shifted.sum()
        turned = turned_angles(theta, centring_step(np.exp(1j * theta), shifted))
        left.append(abs(shifted @ np.exp(1j * turned)) / t**2)
    assert max(left) < 1.0  # of first order, by the mean of the squares, they would be 0.2 / t


@pytest.mark.parametrize(("shift", "kept"), [(0.02, True), (0.9, False)])
def test_the_center_is_released_within_its_cell_only(shift: float, kept: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """A minimum that leaves the center's image outside the star of the central vertex is not taken."""
    V, F = flat_disk(400)
    surface, problem = factorized(V, F)
    measure = centred_measure(surface, problem)
    gauge = CentreGauge(measure.vertex_measure, measure.theta)
    limits = {"minus_area": True, "tolerance": 1e-10, "max_iterations": 50, "progress": Progress()}
    found = minimise_boundary_energy(problem, measure.theta, gauge, **limits)
    moved = BoundaryEnergy(problem, turned_angles(found.energy.theta, shift), minus_area=True)
    mean = abs(measure.vertex_measure @ moved.z)
    z = found.energy.positions()
    star = np.unique(F[(F == measure.centre).any(axis=1)])
    assert (mean < np.abs(z[star] - z[measure.centre]).max()) == kept
    monkeypatch.setattr(centre_cell, "WORTH_WHILE", 0.0)
    monkeypatch.setattr(
        centre_cell,
        "minimise_boundary_energy",
        lambda *args, **options: NewtonResult(moved, found.history[-1:], True, Status.CONVERGED),
    )
    result = centre_cell.release_centre(surface, problem, measure, found, DiskOptions(), Progress())
    assert result.energy is (moved if kept else found.energy)


def test_pins_where_a_moebius_map_of_the_vertices_folds() -> None:
    """Then the moved boundary is extended harmonically: on a flat Delaunay mesh an embedding (Tutte)."""
    V, F = meshes.scattered_disk(30, 16, seed=4)
    own = cuv.DiskMapper(V, F, laplacian="cotan")
    surface, problem = factorized(V, F)
    z = own.map(method="linear").uv @ [1.0, 1.0j]
    loop = own.boundary
    folded = 0
    for second in range(1, len(loop) - 1):
        pins = tuple(int(v) for v in loop[[0, second, second + 1]])
        pointwise = Moebius.from_three_pairs(z[list(pins)], CUBE_ROOTS)(z)
        folded += len(flipped_faces(pointwise, surface.corners)) > 0
        placed, folds = place_pins(problem, surface.corners, z, pins)
        assert len(folds) == len(flipped_faces(placed, surface.corners)) == 0
        np.testing.assert_array_equal(placed[list(pins)], CUBE_ROOTS)
        np.testing.assert_allclose(placed[loop], pointwise[loop], atol=1e-12)
    assert folded > 0


def test_lost_is_what_lies_within_some_roundings() -> None:
    """A height of 2 eps is rounding; one of 4,500 roundings is none, nor are equal sides of that length."""
    z = np.array([0.0, 1.0, 0.5 + 2j * EPS, 0.5 + 1e-12j, 1e-12, 0.5e-12 + 0.9e-12j, 0.5 * EPS, 0.5j * EPS])
    corners = np.array([[0, 1, 2], [0, 1, 3], [0, 4, 5], [0, 6, 7]], dtype=np.int32).T
    assert unresolved_faces(z, np.ascontiguousarray(corners), np.arange(4)).tolist() == [0, 3]


@pytest.mark.parametrize("away", [0.3, 0.2 - 0.35j])
def test_a_center_that_repair_moved_comes_back_by_a_moebius_map(away: complex) -> None:
    V, F = flat_disk(400)
    surface, problem = factorized(V, F)
    z = (V[:, :2] @ [1.0, 1.0j]).astype(np.complex128)
    rim = int(problem.boundary[0])
    moved = Moebius.to_zero(away, z[rim])(z)
    moved[rim] = 1.0
    center = int(np.argmin(np.abs(z)))
    assert abs(moved[center]) > 0.2 and not len(flipped_faces(moved, surface.corners))
    back = recentred(moved, center, surface.corners)
    assert back[center] == 0.0 and back[rim] == 1.0
    np.testing.assert_allclose(back, Moebius.to_zero(moved[center], 1.0)(moved), atol=1e-12)


def test_newton_goes_on_only_while_the_angles_are_better_than_ever(monkeypatch: pytest.MonkeyPatch) -> None:
    """Than ever, not than at first: a step that gives back half of what was gained ends it."""
    means = iter([5.0, 4.0, 4.0, 4.5])
    monkeypatch.setattr(auto, "_angle_mean", lambda surface, z: next(means))
    energy = SimpleNamespace(positions=lambda: None)
    watch = auto._Watch(None, energy)
    assert [watch(energy) for _ in range(3)] == [True, True, False]


@pytest.mark.parametrize(
    ("means", "folds", "converged", "always", "chosen"),
    [
        ((5.0, 5.005), (1, 0), (True, True), False, 1),  # nobody looks for the difference
        ((5.0, 5.02), (1, 0), (True, True), False, 0),
        ((5.0, 5.02), (1, 0), (True, True), True, 1),
        ((5.0, 4.995), (0, 0), (True, False), False, 0),
        ((5.0, 4.995), (0, 0), (True, True), False, 1),
    ],
)
def test_of_maps_with_angles_alike_the_one_with_fewer_folds(
    means: tuple, folds: tuple, converged: tuple, always: bool, chosen: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    told = iter(means)
    monkeypatch.setattr(mapper, "AngleMean", lambda *args: SimpleNamespace(first=next(told)))
    candidates = [
        mapper._Finished(SimpleNamespace(converged=done), np.zeros(1, complex), np.arange(count), None, None)
        for count, done in zip(folds, converged, strict=True)
    ]
    assert cuv.DiskMapper(*meshes.plate(3, 3))._better(candidates, always) is candidates[chosen]


def test_a_part_of_a_patch_moves_only_where_that_mends_some_of_its_folds() -> None:
    """Three triangles apart: one mended, one as folded as before, one folded anew."""
    z = np.arange(9) + 0.0j
    corners = np.arange(9, dtype=np.int32).reshape(3, 3).T.copy()
    found = _where_better(corners, np.ones(9, dtype=bool), z, np.array([0, 1]), z + 1.0j, np.array([1, 2]))
    np.testing.assert_array_equal(found.imag, [1, 1, 1, 0, 0, 0, 0, 0, 0])


def test_a_vertex_that_sees_half_under_one_boundary_vertex_is_placed_point_by_point(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """No map of the disk brings the mean of the boundary to 0 then; with less than half there is one."""
    surface, problem = factorized(*flat_disk(200))
    z = problem.extend(np.exp(1j * centred_measure(surface, problem).theta))
    nb = len(problem.boundary)
    placed, first, center = z.copy(), int(problem.boundary[0]), int(problem.interior[0])
    for most in (0.5, 0.9, 0.45):
        measure = np.full(nb, (1.0 - most) / (nb - 1))
        measure[7] = most
        monkeypatch.setattr(problem, "harmonic_measure", lambda vertex, measure=measure: measure)
        found = placement._extended_about(problem, z, placed, center, first)
        assert (found is placed) == (most >= 0.5)
        if most < 0.5:
            assert abs(measure @ found[problem.boundary]) < 1e-12 and abs(found[first] - 1.0) < 1e-15


def test_the_center_is_restored_without_a_turn() -> None:
    """The gauge keeps the image of the center at 0 and the mean angle as it was at first."""
    theta = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
    measure = 1.0 + 0.5 * np.cos(theta)
    gauge = CentreGauge(measure / measure.sum(), theta)
    restored = gauge.restore(theta + 0.4 + 0.2 * np.sin(theta))
    assert abs(measure @ np.exp(1j * restored)) < 1e-12
    assert measure @ restored == pytest.approx(measure @ theta, rel=1e-14)


def test_pins_that_are_linked_hold_no_more_than_they_say() -> None:
    """Two of three pins in one chain: two constraints, and all that leaves both chains at rest is free."""
    links = np.zeros(12, dtype=bool)
    links[[3, 4, 8]] = True
    tangent = Tangent(PinGauge(np.array([3, 5, 10])), np.linspace(0.0, 6.0, 12), links, FourierPreconditioner(12))
    for seed in range(5):
        free = np.random.default_rng(seed).normal(size=12)
        free[[3, 4, 5, 10]], free[9] = 0.0, free[8]
        np.testing.assert_allclose(tangent.project(free), free, atol=1e-14)
