"""The result of a map to a rectangle."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..concise import Concise
from ..disk.repair import Repair
from ..mesh.surface import Surface
from ..operators.distortion import Distortion, distortion_of
from ..operators.plane_map import PlaneMap
from ..shown import Shown

__all__ = ["RectangleMap"]


@dataclass(frozen=True, eq=False, repr=False)
class RectangleMap(PlaneMap, Shown, Concise):
    """A map of a surface to the rectangle [0, w] x [0, 1].

    Attributes
    ----------
    uv : (n, 2) float64
        Position of every vertex. The boundary lies on the sides of the rectangle, exactly.
    boundary : (nb,) int64
        The boundary loop, in the direction of the faces.
    corners : (4,) int64
        The vertices at (0, 0), (w, 0), (w, 1) and (0, 1).
    modulus : float
        The width w: the conformal modulus of the surface with these corners, as far as its triangles tell.
    modulus_bounds : (float, float)
        Numbers that the conformal modulus of the surface (of its triangles, as they lie in space) is certain to lie
        between. Where triangles have no area nothing is certain, and they are 0 and infinity.
    flipped : (k,) int64
        Faces with non-positive signed area in uv, decided exactly.
    squashed : (k,) int64
        Those of them that have all three vertices on one side of the rectangle, where no map gives them area.
    repair : Repair or None
        What restoring folded faces cost; None where nothing was done.
    status : str
        "direct": nothing is iterated.
    laplacian : str
        "cotan" or "intrinsic-delaunay".
    backend : str
        Library of the factorizations.
    """

    uv: NDArray[np.float64]
    boundary: NDArray[np.int64]
    corners: NDArray[np.int64]
    modulus: float
    modulus_bounds: tuple[float, float]
    flipped: NDArray[np.int64]
    squashed: NDArray[np.int64]
    repair: Repair | None
    status: str
    laplacian: str
    backend: str
    surface: Surface = field(repr=False)

    @cached_property
    def distortion(self) -> Distortion:
        """Angle error, quasi-conformal ratio and area scale of every face (area in units of V squared)."""
        return distortion_of(self.surface.geometry, self.surface.corners, self.uv, self.surface.unit)
