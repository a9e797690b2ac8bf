"""L-BFGS and the barrier energy of plane maps."""

from __future__ import annotations

import numpy as np
import pytest
from meshes import scattered_disk
from numpy.typing import NDArray

from conformal_uv import samples
from conformal_uv.disk.untangling import untangled
from conformal_uv.mesh.surface import Surface
from conformal_uv.operators.conformal_barrier import BarrierPlace, FaceDerivatives
from conformal_uv.operators.distortion import distortion_of
from conformal_uv.optimize import Status, lbfgs
from conformal_uv.progress import Progress

Real = NDArray[np.float64]


class Well:
    """``sum c (x - 1)^2 / 2 - log x`` over two numbers: convex, infinite from 0 on."""

    def __init__(self, x: Real) -> None:
        self.x = x
        self.value = float((np.array([1.0, 50.0]) * (x - 1.0) ** 2 / 2 - np.log(x)).sum()) + 10.0
        self.gradient = np.array([1.0, 50.0]) * (x - 1.0) - 1.0 / x

    def room(self, direction: Real) -> float:
        down = direction < 0.0
        return float((-self.x[down] / direction[down]).min(initial=np.inf))

    def moved(self, step: Real) -> Well | None:
        return Well(self.x + step) if (self.x + step > 0.0).all() else None


def test_lbfgs_finds_the_minimum_before_the_barrier() -> None:
    seen: list[float] = []
    found, status = lbfgs(
        Well(np.array([5.0, 1e-3])),
        lambda gradient: gradient,
        tolerance=1e-14,
        max_iterations=100,
        progress=Progress(),
        stage="wells",
        watch=lambda place: seen.append(place.value),
    )
    c = np.array([1.0, 50.0])
    np.testing.assert_allclose(found.x, 0.5 + np.sqrt(0.25 + 1.0 / c), atol=1e-6)  # c (x - 1) = 1 / x
    assert status in (Status.CONVERGED, Status.STALLED)
    assert seen == sorted(seen, reverse=True) and len(seen) < 40


def test_lbfgs_tells_why_it_stops() -> None:
    def run(start: Real, inverse, most: int) -> Status:
        return lbfgs(Well(start), inverse, tolerance=1e-12, max_iterations=most, progress=Progress(), stage="")[1]

    assert run(np.array([5.0, 5.0]), lambda g: g, 2) == "max-iterations"
    assert run(np.array([5.0, 5.0]), lambda g: -g, 9) == "stalled"  # uphill
    assert run(np.array([5.0, 5.0]), lambda g: g, 99) in ("converged", "stalled")


@pytest.fixture(scope="module")
def place() -> tuple[Surface, BarrierPlace]:
    V, F = samples.mask(150)
    surface = Surface.from_arrays(V, F)
    z = surface.V[:, :2] @ [1, 1j]
    free = np.arange(2, surface.n)
    return surface, BarrierPlace(FaceDerivatives(surface, np.arange(surface.m)), free, z)


def test_the_energy_is_that_of_the_singular_values(place) -> None:
    surface, here = place
    K = distortion_of(surface.geometry, surface.corners, here.z.view(np.float64).reshape(-1, 2)).quasi_conformal
    assert here.finite and here.value == pytest.approx((0.5 * (K + 1 / K - 2)).sum())


def test_the_gradient_is_the_derivative(place) -> None:
    _, here = place
    direction = np.random.default_rng(0).normal(size=len(here.gradient))
    h = 1e-6 * here.room(direction)
    slope = (here.moved(h * direction).value - here.moved(-h * direction).value) / (2 * h)
    assert here.gradient @ direction == pytest.approx(slope, rel=1e-6)


@pytest.mark.parametrize("softness", [1e-3, 1.0])
def test_a_soft_barrier_has_an_energy_where_faces_fold(place, softness: float) -> None:
    surface, here = place
    z = here.z.copy()
    inner = int(np.setdiff1d(np.arange(surface.n), surface.loops[0])[20])
    z[inner] += 0.4 * np.ptp(z.real)  # across some faces
    folded = BarrierPlace(FaceDerivatives(surface, np.arange(surface.m)), np.arange(2, surface.n), z, softness)
    assert (folded.jacobian < 0.0).any() and folded.finite and np.isfinite(folded.value)
    assert not folded.softened(0.0).finite
    direction = np.random.default_rng(0).normal(size=len(folded.gradient))
    assert folded.room(direction) == np.inf
    h = 1e-5 * softness / np.abs(direction).max() * 1e-3
    slope = (folded.moved(h * direction).value - folded.moved(-h * direction).value) / (2 * h)
    assert folded.gradient @ direction == pytest.approx(slope, rel=1e-4)
    D, size = folded.jacobian, np.abs(folded._p) ** 2 + np.abs(folded._q) ** 2
    told = (size / (0.5 * (D + np.hypot(D, softness))) - 1.0).sum()
    assert folded.value == pytest.approx(told, rel=1e-8)


def test_room_ends_where_a_face_has_no_area(place) -> None:
    _, here = place
    for seed in range(5):
        direction = np.random.default_rng(seed).normal(size=len(here.gradient))
        room = here.room(direction)
        assert here.moved(room * (1 - 1e-9) * direction) is not None
        assert here.moved(room * (1 + 1e-9) * direction) is None
    assert here.room(np.zeros(len(here.gradient))) == np.inf


@pytest.mark.parametrize("inner", [40, 3000])
def test_the_first_hessian_is_that_of_the_frozen_energy(inner: int) -> None:
    """The Hessian of sum 2 |q|^2 / |p0|^2, with and without an order of elimination of our own."""
    V, F = scattered_disk(inner, 20, seed=1)
    V[:, 2] = 0.2 * V[:, 0] ** 2
    surface = Surface.from_arrays(V, F)
    faces = FaceDerivatives(surface, np.arange(surface.m))
    free = np.arange(2, surface.n)
    here = BarrierPlace(faces, free, surface.V[:, :2] @ [1, 1j])
    x = np.random.default_rng(0).normal(size=2 * len(free))
    full = np.zeros(surface.n, dtype=complex)
    full[free] = x.view(complex)
    weights = 4.0 / np.abs(faces.P @ here.z) ** 2
    product = (faces.Q.conj().T @ (weights * (faces.Q @ full)))[free].view(float)
    solved = here.held_hessian(surface.V[free], "auto").solve(product)
    np.testing.assert_allclose(solved, x, atol=1e-4)  # SHIFT times the condition


def test_a_patch_shrunk_to_a_point_is_left_as_it_is() -> None:
    """No softness is a part of a mean area of 0: the barrier would divide by it."""
    surface = Surface.from_arrays(*scattered_disk(40, 20, seed=1))
    z = np.zeros(surface.n, dtype=complex)
    every, movable = np.arange(surface.m), np.ones(surface.n, dtype=bool)
    with np.errstate(all="raise"):
        found = untangled(surface, z, movable, lambda z: every, "auto", Progress())
    assert not found.any()
