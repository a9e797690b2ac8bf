"""The least ratio of two Hermitian forms of points on the circle, over their angles, for many rows of points at once.

Newton's method with the Hessian's eigenvalues made positive, for rows of so few points that its matrix is at hand.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..optimize.rows import RowStep, line_search_rows
from .angle_steps import gaps

__all__ = ["RatioRows", "least_ratios"]

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]
Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]

LEAST_BELOW = 1e-12  # of the form below, both scaled to 1
TOLERANCE = 1e-13  # of the gradient; quadratic convergence ends at rounding
MOST_STEPS = 100
LEAST_CURVATURE = 1e-6  # of the largest eigenvalue
SMALLEST_GAP = 1e-12  # radians, at the start
LONGEST = 3.0  # change of a logarithm in one step
NOISE = 64.0 * np.finfo(np.float64).eps


class RatioRows(NamedTuple):
    """What came of r rows: angles (r, nb), ratios and gradients' norms (r,) there, and the steps.

    Gradients are over the logarithms of the gaps, ratios of the forms scaled by their largest entries; NaN where there
    was nothing to be minimised.
    """

    theta: Real
    value: Real
    norm: Real
    steps: list[RowStep]


class _Place:
    """Ratios, their gradients and Hessians in the logarithms of the gaps between neighbours.

    The gaps are in proportion to the exponentials of these, so that their order stays whatever the step.
    """

    def __init__(self, above: Complex, below: Complex, logs: Real) -> None:
        self._forms, self.logs = (above, below), logs
        grown = np.exp(logs - logs.max(axis=1, keepdims=True))
        self._part = grown / grown.sum(axis=1, keepdims=True)
        self.theta = _angles(self._part)
        self._z = np.exp(1j * self.theta)
        self._pulls = [np.conj(self._z) * (form @ self._z[:, :, None])[:, :, 0] for form in self._forms]
        high, low = (pull.real.sum(axis=1) for pull in self._pulls)
        good = low > LEAST_BELOW
        self._low = np.where(good, low, 1.0)[:, None]
        self._ratio = np.where(good, high, 0.0)[:, None] / self._low
        self.value: Real = np.where(good, self._ratio[:, 0], np.inf)
        self._slopes = [2.0 * pull.imag for pull in self._pulls]
        self._along = (self._slopes[0] - self._ratio * self._slopes[1]) / self._low  # over the angles
        beyond = self._along.sum(axis=1, keepdims=True) - np.cumsum(self._along, axis=1)  # of those that a gap moves
        self._bent = 2.0 * np.pi * beyond * self._part
        self._sum = self._bent.sum(axis=1, keepdims=True)
        self.gradient: Real = self._bent - self._sum * self._part
        self.norm: Real = np.linalg.norm(self.gradient, axis=1)

    def some(self, kept: Bools) -> _Place:
        """Some of the rows."""
        return self if kept.all() else _Place(self._forms[0][kept], self._forms[1][kept], self.logs[kept])

    def moved(self, rows: Ints, logs: Real) -> _Place:
        """Some of the rows elsewhere."""
        return _Place(self._forms[0][rows], self._forms[1][rows], logs)

    @property
    def point(self) -> Real:
        """The logarithms (r, nb)."""
        return self.logs

    def searched(self) -> tuple[Real, Real]:
        """Parts (r,) of the directions, 0 where none lowers the ratio, and the logarithms there."""
        direction, noise = self.directions(), NOISE * (1.0 + np.abs(self.value))
        slope = np.einsum("rk,rk->r", self.gradient, direction)

        def move(rows: Ints, length: float) -> _Place:
            return self.moved(rows, self.logs[rows] + length * direction[rows])

        return line_search_rows(self, slope, noise, move)[:2]

    def directions(self) -> Real:
        """Newton's, of descent; all logarithms alike are no direction."""
        turn = 2.0 * np.pi * self._part
        nb = turn.shape[1]
        before = np.tri(nb, k=-1)  # an angle is the sum of the gaps before it
        J = before * turn[:, None, :]
        J -= (turn @ before.T)[:, :, None] * self._part[:, None, :]
        part, bent = self._part, self._bent
        crossed = part[:, :, None] * bent[:, None, :]
        H = J.transpose(0, 2, 1) @ self._hessian() @ J - crossed - crossed.transpose(0, 2, 1)
        H += 2.0 * self._sum[:, :, None] * part[:, :, None] * part[:, None, :]
        np.einsum("rkk->rk", H)[...] += bent - self._sum * part
        size, axes = np.linalg.eigh(0.5 * (H + H.transpose(0, 2, 1)))
        size = np.abs(size)
        size = np.maximum(size, LEAST_CURVATURE * size.max(axis=1, keepdims=True) + np.finfo(np.float64).tiny)
        along = np.einsum("rkc,rk->rc", axes, self.gradient) / size
        step = -np.einsum("rkc,rc->rk", axes, along)
        step -= step.mean(axis=1, keepdims=True)
        return step / np.maximum(1.0, np.abs(step).max(axis=1, keepdims=True) / LONGEST)

    def _hessian(self) -> Real:
        """Over the angles."""
        turned = np.conj(self._z)[:, :, None] * self._z[:, None, :]
        one, other = (2.0 * np.real(form * turned) for form in self._forms)
        for H, pull in ((one, self._pulls[0]), (other, self._pulls[1])):
            np.einsum("rkk->rk", H)[...] -= 2.0 * pull.real
        mixed = self._along[:, :, None] * self._slopes[1][:, None, :]
        return (one - self._ratio[:, :, None] * other - mixed - mixed.transpose(0, 2, 1)) / self._low[:, :, None]


def least_ratios(above: Complex, below: Complex, theta: Real) -> RatioRows:
    """Angles, near those given and in their order, of the least ``z* above z / z* below z``, z = exp(i theta).

    Parameters
    ----------
    above, below : (r, nb, nb) complex128
        Hermitian.
    theta : (r, nb) float64
        Increasing within one turn; the first of each row comes back as 0.
    """
    sizes = [np.abs(form).max(axis=(1, 2)) for form in (above, below)]
    usable = np.logical_and.reduce([(size > 0.0) & np.isfinite(size) for size in sizes])  # others overflow, on needles
    left = np.flatnonzero(usable)
    above, below = (form[left] / size[left, None, None] for form, size in zip((above, below), sizes, strict=True))
    theta = theta - theta[:, :1]
    value, norm = np.full((2, len(theta)), np.nan)
    here = _Place(above, below, np.log(np.maximum(gaps(theta[left]), SMALLEST_GAP)))
    open_ = np.isfinite(here.value)
    left, here = left[open_], here.some(open_)
    steps: list[RowStep] = []
    for _ in range(MOST_STEPS):
        value[left], norm[left], theta[left] = here.value, here.norm, here.theta
        open_ = here.norm > TOLERANCE
        left, here = left[open_], here.some(open_)
        if not len(left):
            break
        length, logs = here.searched()
        taken = length > 0.0
        steps.append(RowStep(left[taken], here.value[taken], here.norm[taken], length[taken]))
        left, here = left[taken], here.moved(np.flatnonzero(taken), logs[taken])
    return RatioRows(theta, value, norm, steps)


def _angles(part: Real) -> Real:
    """From gaps as parts of a turn (r, nb), the first at 0."""
    return 2.0 * np.pi * np.column_stack((np.zeros(len(part)), np.cumsum(part, axis=1)[:, :-1]))
