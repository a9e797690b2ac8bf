"""Newton's method for the conformal energy on the sphere, the centre of mass held in the middle."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..operators.dirichlet import DirichletProblem
from ..optimize import NewtonStep, Status, line_search, log_fraction, truncated_cg
from ..progress import Progress
from .centring import centred, unit
from .energy import SphereEnergy

__all__ = ["SphereNewton", "minimise_sphere_energy"]

Real = NDArray[np.float64]

VOLUME_KEPT = 0.95  # of the signed volume, by one step
ROUNDS = 24  # of holding the vertices that are in the way of a step,
PATIENCE = 6  # after so many of which the step is halved
NO_FALL = 1e-9  # part of the energy that is no more worth a step, where the gradient does not fall either
EPS = np.finfo(np.float64).eps


class SphereNewton(NamedTuple):
    """Positions (n, 3), the steps, and why they ended."""

    x: Real
    history: tuple[NewtonStep, ...]
    status: Status


class _Held:
    """Tangent directions that keep the centre of mass and some vertices, and the inverse Laplacian on them.

    The six Moebius freedoms: the three that move the centre of mass are constraints, the three rotations leave the
    energy alone, so that the gradient has no part in them.
    """

    def __init__(self, energy: SphereEnergy, mass: Real, problem: DirichletProblem, still: NDArray[np.int64]) -> None:
        self._energy, self._problem, self._still = energy, problem, still
        axes = [self._loose(energy.tangent(mass[:, None] * np.eye(3)[k])).reshape(-1) for k in range(3)]
        self._basis, _ = np.linalg.qr(np.column_stack(axes))

    @cached_property
    def _image(self) -> Real:
        """Preconditioned constraints, (3 n, 3)."""
        return np.column_stack([self._smooth(column) for column in self._basis.T])

    def project(self, vectors: Real) -> Real:
        """Orthogonal projection of tangent vectors (n, 3)."""
        flat = self._loose(vectors).reshape(-1)
        return (flat - self._basis @ (self._basis.T @ flat)).reshape(-1, 3)

    def precondition(self, residual: Real) -> Real:
        """The free direction d that minimises 1/2 d' L d - residual' d."""
        free = self._smooth(residual.reshape(-1))
        held = free - self._image @ np.linalg.solve(self._basis.T @ self._image, self._basis.T @ free)
        return self.project(held.reshape(-1, 3))  # once more, against rounding

    def _smooth(self, residual: Real) -> Real:
        """Pseudo-inverse of the Laplacian, grounded at one vertex, between projections to the sphere."""
        rows = self._loose(residual.reshape(-1, 3))
        rows = rows - rows.mean(axis=0)
        out = np.zeros_like(rows)
        out[self._problem.interior] = self._problem.solve(rows[self._problem.interior])
        return self._loose(self._energy.tangent(out - out.mean(axis=0))).reshape(-1)

    def _loose(self, vectors: Real) -> Real:
        """Vectors (n, 3) without those of the vertices that are held."""
        if not len(self._still):
            return vectors
        vectors = vectors.copy()
        vectors[self._still] = 0.0
        return vectors


def minimise_sphere_energy(
    start: SphereEnergy,
    problem: DirichletProblem,
    mass: Real,
    *,
    tolerance: float,
    max_iterations: int,
    progress: Progress,
    watch: Callable[[Real], bool] = lambda x: True,
) -> SphereNewton:
    """Minimise the energy among maps whose centre of mass is 0.

    Truncated conjugate gradients inside (Steihaug 1983), a line search outside; after every step a Moebius map brings
    the centre of mass back. No step inverts a face: the vertices of faces that it would invert are held from then on,
    which costs the energy nearly nothing, for such faces are tiny. It ends where the gradient of the others is within
    the tolerance, or where the energy's quadratic model has no more than `NO_FALL` to fall and the gradient stays:
    where images of faces are next to nothing, it jumps from one place to the next.

    Parameters
    ----------
    start : SphereEnergy
        At a map with its centre of mass at 0.
    problem : DirichletProblem
        The Laplacian grounded at one vertex.
    mass : (n,) float64
        Sum 1.
    watch : callable
        Given the positions after each step; the iteration ends before the first where it is False.
    """
    history: list[NewtonStep] = []
    energy, first, status = start, None, Status.CONVERGED
    still = np.empty(0, dtype=np.int64)
    for iteration in range(max_iterations + 1):
        held = _Held(energy, mass, problem, still)
        gradient = held.project(energy.gradient)
        norm = float(np.linalg.norm(gradient))
        first = first or norm
        reached = log_fraction(norm, first, tolerance)
        progress("newton", reached)
        if norm <= tolerance:
            break
        if iteration == max_iterations:
            status = Status.MAX_ITERATIONS
            break
        direction, steps = _direction(energy, held, gradient, tolerance, partial(progress, "newton", reached))
        fall = -0.5 * float(np.vdot(gradient, direction))
        if history and norm > 0.5 * history[-1].gradient_norm and 0.0 <= fall <= NO_FALL * abs(energy.value):
            break
        direction, still = _unblocked(energy, mass, direction, still)
        held = _Held(energy, mass, problem, still)
        found = _line_search(energy, held, mass, direction)
        if found is None:
            status = Status.STALLED
            break
        length, better = found
        if not watch(better.x):
            status = Status.ANGLES
            break
        history.append(NewtonStep(energy.value, norm, steps, length))
        energy = better
    history.append(NewtonStep(energy.value, norm, 0, 0.0))
    return SphereNewton(energy.x, tuple(history), status)


def _direction(
    energy: SphereEnergy, held: _Held, gradient: Real, tolerance: float, watch: Callable[[], None]
) -> tuple[Real, int]:
    norm = float(np.linalg.norm(gradient))
    goal = max(min(0.1, np.sqrt(norm)) * norm, 0.3 * tolerance)
    return truncated_cg(gradient, lambda d: held.project(energy.hessian_product(d)), held.precondition, goal, watch)


def _unblocked(
    energy: SphereEnergy, mass: Real, direction: Real, still: NDArray[np.int64]
) -> tuple[Real, NDArray[np.int64]]:
    """The direction without the vertices of faces that it would turn over, and all vertices that are held by now."""
    for number in range(ROUNDS):
        blocking = np.flatnonzero(energy.sound & ~_moved(energy, mass, direction).sound)
        if not len(blocking):
            break
        still = np.union1d(still, energy.vertices_of(blocking))
        direction = direction * (0.5 if number % PATIENCE == PATIENCE - 1 else 1.0)
        direction[still] = 0.0
    return direction, still


def _moved(energy: SphereEnergy, mass: Real, step: Real) -> SphereEnergy:
    return SphereEnergy(energy.laplacian, energy.faces, centred(unit(energy.x + step), mass))


def _line_search(energy: SphereEnergy, held: _Held, mass: Real, direction: Real) -> tuple[float, SphereEnergy] | None:
    gradient = held.project(energy.gradient)
    slope, norm = float(np.vdot(gradient, direction)), float(np.linalg.norm(gradient))
    noise = 64.0 * float(EPS) * (abs(energy.value) + 4.0 * np.pi)
    least = VOLUME_KEPT * _volume(energy)

    def move(length: float) -> SphereEnergy | None:
        trial = _moved(energy, mass, length * direction)
        return trial if trial.sound[energy.sound].all() and _volume(trial) >= least else None

    def gradient_falls(there: SphereEnergy) -> bool:
        return bool(np.linalg.norm(held.project(there.tangent(there.gradient))) < norm)

    return line_search(energy.value, slope, move, gradient_falls, length=1.0, noise=noise)


def _volume(energy: SphereEnergy) -> float:
    """Six times the signed volume of the image."""
    a, b, c = (energy.x[corner] for corner in energy.corners)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)))
