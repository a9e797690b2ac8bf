"""Newton's method on the boundary angles of many disks at once, each with its own steps.

As `disk.newton`, for boundaries so short that the Hessian is at hand as a matrix: directions are solved for directly,
conjugate gradients serve only where it is not positive. Where neighbours come together, no step lowers the energy or
the iteration does not end, nothing is decided here: that disk is left to the way that knows what to do then.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft, rfft

from ..disk.angle_steps import gaps, in_order
from ..disk.newton import LEAST_FORCING, SHORT_PART, SMALLEST_GAP
from ..disk.preconditioner import FourierPreconditioner
from ..optimize.rows import RowStep, line_search_rows
from .boundary_rows import EnergyRows, centred_rows
from .cg_rows import truncated_cg_rows

__all__ = ["NewtonRows", "minimised_rows"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]
Bools = NDArray[np.bool_]
Complex = NDArray[np.complex128]

EPS = float(np.finfo(np.float64).eps)
DEPENDENT = 1e-12  # of the largest normal, up to which another one says the same


class NewtonRows(NamedTuple):
    """What came of r disks.

    Attributes
    ----------
    theta : (r, nb) float64
    converged : (r,) bool
        What is told of the others means nothing.
    value, norm, first : (r,) float64
        Energies at the end, and norms of the projected gradient at the end and at first.
    steps : list of RowStep
    """

    theta: Real
    converged: Bools
    value: Real
    norm: Real
    first: Real
    steps: list[RowStep]


def minimised_rows(
    S: Real,
    theta: Real,
    measure: Real,
    *,
    held: bool,
    tolerance: Real | float,
    relative_tolerance: float,
    max_iterations: int,
) -> NewtonRows:
    """Minimise the energies over the angles; the mean angle by the measure is kept.

    Parameters
    ----------
    S : (r, nb, nb) float64
        Flux operators.
    theta, measure : (r, nb) float64
        Start, increasing within one turn, and the measure.
    held : bool
        Whether the mean of the points by the measure is held at 0, too.
    tolerance : float or (r,) float64
    """
    problem = _Problem(S, measure, np.einsum("rk,rk->r", measure, theta), held=held)
    theta = problem.restored(theta)
    goal = np.maximum(SHORT_PART * tolerance, 64.0 * EPS * problem.degrees)
    value, norm, first = np.full((3, len(theta)), np.nan)
    converged = np.zeros(len(theta), dtype=bool)
    steps: list[RowStep] = []
    left = np.flatnonzero(_apart(theta))
    here = _Place(problem.some(left), theta[left])
    for number in range(max_iterations + 1):
        value[left], norm[left] = here.value, here.norm
        if number == 0:
            first[left] = here.norm
            goal[left] = np.maximum(goal[left], SHORT_PART * relative_tolerance * here.norm)
        done = here.norm <= goal[left]
        converged[left[done]] = True
        if number == max_iterations or done.all():
            break
        left, here = left[~done], here.some(~done)
        direction, sound = here.directions()
        left, here, direction = left[sound], here.some(sound), direction[sound]
        length, there = here.searched(direction)
        taken = length > 0.0
        steps.append(RowStep(left[taken], here.value[taken], here.norm[taken], length[taken]))
        theta[left[taken]] = there.point[taken]
        taken &= _apart(there.point)
        left, here = left[taken], there.some(taken)
    return NewtonRows(theta, converged, value, norm, first, steps)


@dataclass(frozen=True, eq=False)
class _Problem:
    """Flux operators (r, nb, nb), measures (r, nb) and means (r,) of some rows; as `disk.gauge.CentreGauge` where it
    is `held`, else as `TurnGauge`."""

    S: Real
    measure: Real
    mean: Real
    held: bool

    @property
    def degrees(self) -> Real:
        """Sizes (r,) of the diagonals."""
        return np.asarray(np.linalg.norm(np.einsum("rkk->rk", self.S), axis=1))

    def some(self, kept: Bools | Ints) -> _Problem:
        """That of some rows."""
        if len(kept) == len(self.S) and (kept.dtype != bool or kept.all()):
            return self
        return _Problem(self.S[kept], self.measure[kept], self.mean[kept], self.held)

    def restored(self, theta: Real) -> Real:
        """Angles nearby that satisfy the constraints exactly."""
        if self.held:
            theta = centred_rows(theta, self.measure)
        return np.asarray(theta + (self.mean - np.einsum("rk,rk->r", self.measure, theta))[:, None])

    def normals(self, z: Complex) -> Real:
        """(r, nb, 3) or (r, nb, 1), to which steps are orthogonal."""
        measure = self.measure[:, :, None]
        return measure * np.stack((np.ones(z.shape), z.real, z.imag), axis=2) if self.held else measure


class _Place:
    """Energies and projected gradients of some rows at some angles, and Newton's directions from there."""

    def __init__(self, problem: _Problem, theta: Real) -> None:
        self.problem, self.energy = problem, EnergyRows(problem.S, theta)
        self._basis, self._size = np.linalg.qr(problem.normals(self.energy.z))
        self._gradient = self._projected(self.energy.gradient)
        self.norm: Real = np.linalg.norm(self._gradient, axis=1)

    @property
    def point(self) -> Real:
        """The angles (r, nb)."""
        return self.energy.theta

    @property
    def value(self) -> Real:
        """The energies (r,)."""
        return self.energy.value

    def some(self, kept: Bools) -> _Place:
        """Some of the rows."""
        if kept.all():
            return self
        part = _Place.__new__(_Place)
        part.problem, part.energy = self.problem.some(kept), self.energy.some(kept)
        part._basis, part._size = self._basis[kept], self._size[kept]
        part._gradient, part.norm = self._gradient[kept], self.norm[kept]
        return part

    def _projected(self, direction: Real) -> Real:
        along = np.einsum("rkc,rk->rc", self._basis, direction)
        return np.asarray(direction - np.einsum("rkc,rc->rk", self._basis, along))

    def directions(self) -> tuple[Real, Bools]:
        """Newton's directions (r, nb), and which rows have any."""
        basis, across = self._basis, self._basis.transpose(0, 2, 1)
        diagonal = np.abs(np.einsum("rcc->rc", self._size))
        sound = diagonal.min(axis=1) > DEPENDENT * diagonal.max(axis=1)
        H = self.energy.hessian()
        if self.problem.held:
            np.einsum("rkk->rk", H)[...] += self._bend(sound)
        H -= basis @ (across @ H)
        H -= (H @ basis) @ across
        H += basis @ across
        H = 0.5 * (H + H.transpose(0, 2, 1))
        convex = sound.copy()
        try:
            np.linalg.cholesky(H)
        except np.linalg.LinAlgError:
            convex &= np.linalg.eigvalsh(H)[:, 0] > 0.0
        bent = np.flatnonzero(sound & ~convex)
        found = np.empty_like(self._gradient)
        if len(bent):
            found[bent] = self._truncated(H[bent], bent)
        H[~convex] = np.eye(H.shape[1])
        direct = np.linalg.solve(H, -self._gradient[:, :, None])[:, :, 0]
        return self._projected(np.where(convex[:, None], direct, found)), sound

    def searched(self, direction: Real) -> tuple[Real, _Place]:
        """Parts (r,) of the directions, 0 where no step does, and where they lead."""
        slope = np.einsum("rk,rk->r", self.energy.gradient, direction)
        noise = EPS * (64.0 * (np.abs(self.value) + np.pi) + 4.0 * self.problem.degrees)

        def move(rows: Ints, length: float) -> _Place:
            problem = self.problem.some(rows)
            return _Place(problem, problem.restored(in_order(self.point[rows], length * direction[rows])))

        taken, theta, there = line_search_rows(self, slope, noise, move)
        return taken, there if there is not None else _Place(self.problem, theta)

    def _truncated(self, H: Real, rows: Ints) -> Real:
        """Directions (k, nb) of some rows whose Hessians H (k, nb, nb) are not positive."""
        nb = H.shape[1]
        multiplier = FourierPreconditioner(nb).multiplier
        basis, gradient = self._basis[rows], self._gradient[rows]
        across = basis.transpose(0, 2, 1)
        image = irfft(rfft(basis, axis=1) / multiplier[:, None], nb, axis=1)
        gram = across @ image

        def precondition(residual: Real, k: Ints) -> Real:
            free = irfft(rfft(residual, axis=1) / multiplier, nb, axis=1)[:, :, None]
            held = free - image[k] @ np.linalg.solve(gram[k], across[k] @ free)
            return np.asarray((held - basis[k] @ (across[k] @ held))[:, :, 0])

        norm = self.norm[rows]
        goal = np.minimum(0.1, np.maximum(LEAST_FORCING, 0.5 * norm)) * norm
        return truncated_cg_rows(gradient, H, precondition, goal)

    def _bend(self, sound: Bools) -> Real:
        """As `disk.gauge.CentreGauge.curvature`."""
        size = np.where(sound[:, None, None], self._size, np.eye(3))
        along = np.einsum("rkc,rk->rc", self._basis, self.energy.gradient)
        multiplier = np.linalg.solve(size, along[:, :, None])
        z = self.energy.z
        return np.asarray(self.problem.measure * (multiplier[:, 1] * z.imag - multiplier[:, 2] * z.real))


def _apart(theta: Real) -> Bools:
    """Whether no two neighbours have come together, (r,)."""
    return np.asarray((gaps(theta) >= SMALLEST_GAP).all(axis=1))
