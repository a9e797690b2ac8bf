"""The result of a map to the disk."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..mesh.surface import Surface
from ..operators.distortion import Distortion, distortion_of
from .augmented_lagrangian import AugmentedLagrangianStep
from .newton import NewtonStep

__all__ = ["DiskMap"]


@dataclass(frozen=True, eq=False)
class DiskMap:
    """A map of a surface to the unit disk.

    Attributes
    ----------
    uv : (n, 2) float64
        Position of every vertex, ``|uv| <= 1``; boundary vertices on the circle to 1e-12.
    boundary : (nb,) int64
        The boundary loop, in the direction of the faces.
    dirichlet_energy : float
        1/2 uv' L uv, L the cotangent Laplacian with weights (cot a + cot b) / 2.
    conformal_energy : float
        Dirichlet energy minus signed area of the image; 0 where all angles are kept.
    flipped : (k,) int64
        Faces with non-positive signed area in uv.
    converged : bool
        Whether the method reached its tolerance; always true of "linear", which does not iterate.
    history : tuple
        A row for each iteration: NewtonStep or AugmentedLagrangianStep; empty for "linear".
    method, objective : str
        What was solved.
    center : int or None
        The vertex at 0, where there is one.
    pins : tuple of int or None
        The boundary vertices at 1, w, w^2, w = exp(2 pi i / 3), where they were asked for.
    backend : str
        Library of the factorization.
    """

    uv: NDArray[np.float64]
    boundary: NDArray[np.int64]
    dirichlet_energy: float
    conformal_energy: float
    flipped: NDArray[np.int64]
    converged: bool
    history: tuple[NewtonStep, ...] | tuple[AugmentedLagrangianStep, ...]
    method: str
    objective: str
    center: int | None
    pins: tuple[int, int, int] | None
    backend: str
    surface: Surface = field(repr=False)

    @cached_property
    def distortion(self) -> Distortion:
        """Angle error, quasi-conformal ratio and area scale of every face (area in units of V squared)."""
        return distortion_of(self.surface.geometry, self.surface.corners, self.uv, self.surface.unit)

    @property
    def gradient_norm(self) -> float | None:
        """Norm of the projected gradient at the end of Newton's method; None for the other methods."""
        last = self.history[-1] if self.history else None
        return last.gradient_norm if isinstance(last, NewtonStep) else None
