"""Branches that ordinary meshes seldom take, each by itself: a fault there must not pass unseen."""

from __future__ import annotations

from decimal import Decimal, getcontext

import numpy as np
import pytest
from meshes_closed import icosphere
from scipy.spatial.transform import Rotation

from conformal_uv.disk.angle_steps import gaps, in_order
from conformal_uv.disk.gauge import CentreGauge
from conformal_uv.disk.harmonic_measure import CentredMeasure, angles_of_measure, balanced_measure
from conformal_uv.mesh import PolygonMesh, Surface
from conformal_uv.operators.laplacian import intrinsic_geometry
from conformal_uv.optimize import augmented_lagrangian, truncated_cg
from conformal_uv.progress import Progress
from conformal_uv.sphere.centring import surface_rotation
from conformal_uv.sphere.layout import octahedral
from conformal_uv.sphere.puncture import most_regular_vertex


class Scripted:
    """A constrained problem whose constraint norms are given, round by round."""

    def __init__(self, norms: list[float]) -> None:
        self.norms, self.round = norms, -1

    def minimised(self, x, y, rho, tolerance):
        self.round += 1
        return x

    def constraints(self, x):
        return np.array([self.norms[max(self.round, 0)]])

    def kkt_residual(self, x, y) -> float:
        return 1.0


def test_penalty_rises_where_constraints_do_not_fall_by_half_each_update() -> None:
    """The report's schedule: multipliers move below 1e-3 / 2^updates, else the penalty doubles."""
    _, rows, converged = augmented_lagrangian(
        Scripted([2e-3, 9e-4, 6e-4, 4e-4, 3e-4]), np.zeros(1), max_iterations=5, progress=Progress()
    )
    rho = np.array([row.rho for row in rows]) / rows[0].rho
    assert rho.tolist() == [1.0, 2.0, 2.0, 4.0, 4.0] and not converged


class Patient(Scripted):
    """One whose KKT residual falls by a factor of 1,000 each round."""

    def kkt_residual(self, x, y) -> float:
        return 1e-3 ** float(self.round)


@pytest.mark.parametrize(("most", "rounds", "done"), [(9, 4, True), (3, 3, False)])
def test_constraints_that_hold_are_no_solution_yet(most: int, rounds: int, done: bool) -> None:
    """The multipliers belong to it: it ends where the KKT residual is below 1e-8 as well."""
    _, rows, converged = augmented_lagrangian(
        Patient([1e-9] * 9), np.zeros(1), max_iterations=most, progress=Progress()
    )
    assert (len(rows), converged) == (rounds, done)


@pytest.mark.parametrize("lengths", [(100000.0, 99999.99979, 0.00029), (1.0, 1.0, 1e-12), (3.0, 1.5, 1.5000000001)])
def test_areas_of_needles_from_lengths(lengths: tuple[float, float, float]) -> None:
    """Heron's formula in Kahan's order, against decimals; the first triangle is one of his."""
    getcontext().prec = 60
    a, b, c = map(Decimal, lengths)
    exact = float(((a + b + c) * (b + c - a) * (a + c - b) * (a + b - c)).sqrt() / 2)
    found = intrinsic_geometry(np.array(lengths)[:, None]).double_area[0]
    assert found == pytest.approx(exact, rel=1e-14)


def test_the_rotation_to_the_surface_is_none_that_mirrors() -> None:
    """Of a mirrored map the nearest orthogonal matrix is a reflection, which would turn the sphere inside out."""
    rng = np.random.default_rng(0)
    V = rng.normal(size=(50, 3)) * [3.0, 2.0, 1.0]
    mass = np.full(50, 0.02)
    for mirror in ([1, 1, 1], [1, 1, -1], [-1, -1, -1]):
        x = (V - V.mean(axis=0)) * mirror @ Rotation.random(random_state=1).as_matrix()
        found = surface_rotation(x, V, mass)
        assert np.linalg.det(found) == pytest.approx(1.0)
        np.testing.assert_allclose(found @ found.T, np.eye(3), atol=1e-12)
    turned = Rotation.random(random_state=2).as_matrix()
    x = (V - V.mean(axis=0)) @ turned.T
    np.testing.assert_allclose(surface_rotation(x, V, mass) @ turned, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(surface_rotation(x + 0.7, V + 5.0, mass) @ turned, np.eye(3), atol=1e-12)


def test_octahedral_corners_and_equator() -> None:
    """The poles and the equator of the octahedron unfolded to a square, in all eight faces."""
    for signs in np.stack(np.meshgrid([1, -1], [1, -1], [1, -1]), axis=-1).reshape(-1, 3):
        xyz = np.diag(signs).astype(float)
        mesh = PolygonMesh(xyz, np.arange(3), np.array([0, 3]))
        uv = octahedral(xyz, mesh)
        x_axis, y_axis = [0.5 + 0.5 * signs[0], 0.5], [0.5, 0.5 + 0.5 * signs[1]]
        pole = [0.5, 0.5] if signs[2] > 0 else [0.5 + 0.5 * signs[0], 0.5 + 0.5 * signs[1]]
        np.testing.assert_allclose(uv, [x_axis, y_axis, pole], atol=1e-15)
        inside = octahedral(xyz * 0.2 + 0.1 * signs, mesh)  # off the axes: two thirds and a sixth of each
        weights = np.array([[4.0, 1.0, 1.0], [1.0, 4.0, 1.0], [1.0, 1.0, 4.0]])
        weights = (np.eye(3) * 0.2 + 0.1) / (np.eye(3) * 0.2 + 0.1).sum(axis=1, keepdims=True)
        np.testing.assert_allclose(inside, weights @ uv, atol=1e-15)  # affine on each face


def test_a_vertex_with_half_of_the_measure_is_not_centred_on() -> None:
    """No Moebius map of the disk brings to 0 what one boundary vertex sees half of."""
    theta = np.array([0.0, 1.0, 3.0, 5.0])
    heavy = balanced_measure(CentredMeasure(7, np.array([0.5, 0.2, 0.2, 0.1]), theta))
    assert heavy.centre is None and heavy.vertex_measure.sum() == pytest.approx(1.0)
    arcs = np.array([1.0, 2.0, 2.0, 2.0 * np.pi - 5.0])
    np.testing.assert_allclose(heavy.vertex_measure, (arcs + np.roll(arcs, 1)) / (4.0 * np.pi))
    light = CentredMeasure(7, np.array([0.45, 0.25, 0.2, 0.1]), theta)
    assert balanced_measure(light) is light


def test_angles_where_all_measure_is_lost() -> None:
    lengths = np.array([1.0, 2.0, 1.0])
    np.testing.assert_allclose(angles_of_measure(np.zeros(3), lengths), 2.0 * np.pi * np.array([0.0, 0.25, 0.75]))
    np.testing.assert_allclose(angles_of_measure(np.full(3, 1 / 3), np.zeros(3)), 2.0 * np.pi / 3.0 * np.arange(3.0))


def test_curvature_of_the_gauge_is_minus_that_of_its_constraints() -> None:
    """Against differences of the normals times fixed multipliers."""
    rng = np.random.default_rng(3)
    theta = np.sort(rng.uniform(0.0, 2.0 * np.pi, 12))
    measure = rng.random(12)
    gauge = CentreGauge(measure / measure.sum(), theta)
    gradient = rng.normal(size=12)
    multipliers, *_ = np.linalg.lstsq(gauge.normals(theta), gradient, rcond=None)
    step = 1e-6
    expected = [
        -((gauge.normals(theta + step * e) - gauge.normals(theta - step * e)) @ multipliers)[k] / (2.0 * step)
        for k, e in enumerate(np.eye(12))
    ]
    np.testing.assert_allclose(gauge.curvature(theta, gradient), expected, atol=1e-9)


def test_a_step_keeps_the_order_of_the_boundary_and_moves_the_others_as_it_says() -> None:
    n = 4000
    theta = 2.0 * np.pi / n * np.arange(n)
    step = np.zeros(n)
    step[100] = 3.0 * np.pi / n  # past its neighbour
    left = gaps(in_order(theta, step))
    assert gaps(theta + step).min() < 0.0 < left.min()
    others = np.delete(np.arange(n), [99, 100])  # the gaps beside the vertex
    np.testing.assert_allclose(left[others], 2.0 * np.pi / n, rtol=1e-3)
    np.testing.assert_array_equal(in_order(theta, 0.1 * step), theta + 0.1 * step)
    for length in (1e-3, 1e-4):  # to first order it is the step, whatever its length
        np.testing.assert_allclose(in_order(theta, length * step), theta + length * step, atol=1e-18 / length)
    far = in_order(theta, 1e6 * step)
    assert np.isfinite(far).all() and gaps(far).min() >= 0.0 and gaps(far).sum() == pytest.approx(2.0 * np.pi)


def test_the_puncture_is_a_vertex_of_six_edges() -> None:
    """Five equilateral triangles are more regular in their angles than six others, but see less of a plane."""
    V, F = icosphere(0)
    edges = np.unique(np.sort(np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1), axis=0)
    number = {tuple(edge): len(V) + k for k, edge in enumerate(edges.tolist())}
    mid = np.array([[number[tuple(sorted((f[k], f[k - 1])))] for k in (1, 2, 0)] for f in F.tolist()])
    faces = [mid]
    for k in range(3):  # each corner with the middles of the two sides at it
        faces.append(np.column_stack((F[:, k], mid[:, k], mid[:, k - 1])))
    F = np.concatenate(faces)
    V = np.concatenate((V, V[edges].mean(axis=1)))
    star = np.unique(F[(F == 0).any(axis=1)])
    others = np.setdiff1d(np.arange(len(V)), star)
    V[others] += 0.03 * np.random.default_rng(0).normal(size=(len(others), 3))
    surface = Surface.from_arrays(V, F)
    angles = np.arctan2(surface.geometry.double_area, surface.geometry.dot)
    assert np.abs(np.degrees(angles[:, (F == 0).any(axis=1)]) - 60.0).max() < 1e-9
    assert np.bincount(F.reshape(-1))[most_regular_vertex(surface)] == 6


def test_conjugate_gradients_end_where_the_preconditioner_sees_nothing() -> None:
    """What it makes of the residual is orthogonal to that: rounding on needles."""
    found, steps = truncated_cg(np.ones(4), lambda d: d, lambda r: np.array([1.0, -1.0, 0.0, 0.0]), 1e-3)
    assert np.isfinite(found).all() and steps == 1
