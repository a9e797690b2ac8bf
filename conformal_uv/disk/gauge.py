"""What keeps the three Moebius degrees of freedom still while the boundary angles are optimised."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..operators.moebius import centring_step, turned_angles

__all__ = ["CentreGauge", "Gauge", "PinGauge", "TurnGauge"]

Real = NDArray[np.float64]


class Gauge(Protocol):
    """Constraints on the boundary angles."""

    def normals(self, theta: Real) -> Real:
        """Columns (nb, c) to which a step must be orthogonal to keep the constraints to first order."""
        ...

    def curvature(self, theta: Real, gradient: Real) -> Real:
        """Diagonal (nb,) to add to the Hessian: minus the constraints' own, times their multipliers."""
        ...

    def restore(self, theta: Real) -> Real:
        """Angles nearby that satisfy the constraints exactly."""
        ...


class CentreGauge:
    """The image of the centre stays at 0 and the mean angle still.

    The centre lies at ``sum_k h_k exp(i theta_k)``, h its harmonic measure, so steps are kept orthogonal to
    (h, h cos theta, h sin theta) and a Moebius map of the disk takes up what is left of second order.
    """

    def __init__(self, measure: Real, theta: Real) -> None:
        self._measure = measure
        self._mean = float(measure @ theta)

    def normals(self, theta: Real) -> Real:
        """See Gauge."""
        return self._measure[:, None] * np.column_stack((np.ones_like(theta), np.cos(theta), np.sin(theta)))

    def curvature(self, theta: Real, gradient: Real) -> Real:
        """See Gauge; the multipliers are those of least squares."""
        (_, along_cos, along_sin), *_ = np.linalg.lstsq(self.normals(theta), gradient, rcond=None)
        return self._measure * (along_cos * np.sin(theta) - along_sin * np.cos(theta))

    def restore(self, theta: Real) -> Real:
        """See Gauge."""
        for _ in range(50):
            step = centring_step(np.exp(1j * theta), self._measure)
            theta = turned_angles(theta, step)
            if abs(step) < 1e-15:
                break
        return theta + (self._mean - float(self._measure @ theta))


class TurnGauge:
    """Only the mean angle stays still; the image of the centre may move."""

    def __init__(self, measure: Real, theta: Real) -> None:
        self._measure = measure
        self._mean = float(measure @ theta)

    def normals(self, theta: Real) -> Real:
        """See Gauge."""
        return self._measure[:, None]

    def curvature(self, theta: Real, gradient: Real) -> Real:
        """See Gauge; linear constraints have none."""
        return np.zeros_like(theta)

    def restore(self, theta: Real) -> Real:
        """See Gauge."""
        return theta + (self._mean - float(self._measure @ theta))


class PinGauge:
    """Three boundary vertices stay where they are."""

    def __init__(self, pinned: NDArray[np.int64]) -> None:
        self._pinned = pinned

    def normals(self, theta: Real) -> Real:
        """See Gauge."""
        columns = np.zeros((len(theta), 3))
        columns[self._pinned, [0, 1, 2]] = 1.0
        return columns

    def curvature(self, theta: Real, gradient: Real) -> Real:
        """See Gauge; linear constraints have none."""
        return np.zeros_like(theta)

    def restore(self, theta: Real) -> Real:
        """See Gauge."""
        return theta
