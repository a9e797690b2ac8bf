"""The result of a map to the sphere."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..concise import Concise
from ..mesh.surface import Surface
from ..operators.areas import lumped_areas
from ..operators.distortion import Distortion, distortion_of
from ..optimize import AugmentedLagrangianStep, NewtonStep
from ..shown import Shown

__all__ = ["SphereMap"]


@dataclass(frozen=True, eq=False, repr=False)
class SphereMap(Shown, Concise):
    """A map of a closed surface to the unit sphere.

    Attributes
    ----------
    xyz : (n, 3) float64
        Position of every vertex, ``|xyz| = 1`` to 1e-12, the surface's outside outside.
    dirichlet_energy : float
        1/2 tr(xyz' L xyz), L the Laplacian that was solved with.
    conformal_energy : float
        Dirichlet energy minus the area of the image of the triangles whose Laplacian L is; inverted ones count
        negative.
    signed_volume : float
        Of the image polyhedron; near 4 pi / 3 for a map that covers the sphere once with its orientation kept.
    flipped : (k,) int64
        Faces that are not anticlockwise seen from outside the sphere.
    converged : bool
        Whether the method reached its tolerance; always true of "linear", which does not iterate.
    history : tuple
        A row for each iteration, NewtonStep or AugmentedLagrangianStep; empty for "linear".
    repaired : int
        Number of inverted faces that were unfolded.
    method, normalization, laplacian : str
        What was solved (of "auto", which of its methods it is), how the Moebius freedom was fixed, and which weights
        were used.
    status : str
        Why that stopped: "direct" (nothing to iterate to a tolerance), "converged", "stalled" (no step lowers the
        energy any more without folding a face), "max-iterations"; of "auto" that did without Newton's method,
        "angles" (it made them worse) or "no-gain" (a surface so fine that it was not begun).
    """

    xyz: NDArray[np.float64]
    dirichlet_energy: float
    conformal_energy: float
    signed_volume: float
    flipped: NDArray[np.int64]
    converged: bool
    history: tuple[NewtonStep, ...] | tuple[AugmentedLagrangianStep, ...]
    repaired: int
    method: str
    status: str
    normalization: str
    laplacian: str
    surface: Surface = field(repr=False)
    full: NDArray[np.float64] = field(repr=False)

    @cached_property
    def distortion(self) -> Distortion:
        """Angle error, quasi-conformal ratio and area scale of every face (area in units of V squared).

        Faces of virtual caps come after the caller's own.
        """
        return distortion_of(self.surface.geometry, self.surface.corners, self.full, self.surface.unit)

    @property
    def around_surface(self) -> NDArray[np.float64]:
        """The map on the sphere that has the surface's area and its centre of mass, (n, 3) in the units of V."""
        surface = self.surface
        area = lumped_areas(surface.geometry, surface.corners, surface.n)
        total = float(area.sum())
        middle = area @ surface.V / total if total > 0.0 else surface.V.mean(axis=0)
        return (middle + np.sqrt(total / (4.0 * np.pi)) * self.xyz) * surface.unit

    @property
    def gradient_norm(self) -> float | None:
        """Norm of the projected gradient at the end of Newton's method; None for "linear"."""
        last = self.history[-1] if self.history else None
        return last.gradient_norm if isinstance(last, NewtonStep) else None
