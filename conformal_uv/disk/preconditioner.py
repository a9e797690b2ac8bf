"""Preconditioners for the Hessian in the boundary angles, about the inverse of the Dirichlet-to-Neumann map.

In the angle the Hessian of the continuous problem is the Fourier multiplier |k| - 1, the norm of H^1/2 less its
Moebius part. That norm keeps its size under changes of coordinate, so the number of a vertex along the boundary
serves as the coordinate: no interpolation, and no two vertices fall into one cell of a grid. Of short boundaries that
is enough; on long ones the triangles along the boundary are heeded, too, see `NeumannStrip`.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft, rfft

from ..operators.dirichlet import DirichletProblem
from ..operators.neumann_strip import SHORT

__all__ = ["FourierPreconditioner", "Preconditioner", "StripPreconditioner", "preconditioner", "smooth_preconditioner"]

Real = NDArray[np.float64]

Preconditioner = Callable[[Real], Real]

LONG_WAVES = 16  # where k - 1 is no more nearly k


def preconditioner(problem: DirichletProblem, theta: Real) -> Preconditioner:
    """The one for this boundary at these angles (nb,)."""
    nb = len(problem.boundary)
    return FourierPreconditioner(nb) if nb <= SHORT else StripPreconditioner(problem, theta)


def smooth_preconditioner(problem: DirichletProblem, theta: Real) -> Preconditioner:
    """One that knows the boundary's length only, on any boundary: directions come out smooth along it."""
    return FourierPreconditioner(len(theta))


class StripPreconditioner:
    """The inverse of |k|, from the strip of the mesh along the boundary, turned into that of |k| - 1 for long waves.

    Parameters
    ----------
    problem : DirichletProblem
    theta : (nb,) float64
    """

    def __init__(self, problem: DirichletProblem, theta: Real) -> None:
        self._inverse = problem.boundary_inverse
        k = np.arange(2, LONG_WAVES + 1)
        self._waves = np.concatenate((np.cos(theta[:, None] * k), np.sin(theta[:, None] * k)), axis=1)
        self._more = np.tile(1.0 / (np.pi * (k - 1)) - 1.0 / (np.pi * k), 2)  # cos(k t) has the energy pi k / 2

    def __call__(self, residual: Real) -> Real:
        """Apply to a residual (nb,)."""
        return self._inverse(residual) + self._waves @ (self._more * (residual @ self._waves))


class FourierPreconditioner:
    """``irfft(rfft(r) / multiplier)`` over nb boundary vertices, the multiplier ``max(|k| - 1, 1)``."""

    def __init__(self, nb: int) -> None:
        self._size = nb
        self.multiplier = np.maximum(np.arange(nb // 2 + 1) - 1.0, 1.0)

    def __call__(self, residual: Real) -> Real:
        """Apply to a residual (nb,)."""
        return irfft(rfft(residual) / self.multiplier, self._size)
