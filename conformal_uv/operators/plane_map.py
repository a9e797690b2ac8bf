"""What every map to the plane tells of itself, whatever its shape."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..mesh.geometry import triangle_geometry
from ..mesh.surface import Surface
from .wirtinger import conformal_energy, enclosed_area

__all__ = ["PlaneMap", "unresolved_faces"]

RESOLUTION = 16.0 * np.finfo(np.float64).eps  # of a position in the disk, with a few operations behind it


def unresolved_faces(
    z: NDArray[np.complex128], corners: NDArray[np.int32], faces: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Those of the faces whose height, in a map of about the size of the unit disk, is within rounding."""
    points = np.ascontiguousarray(z).view(np.float64).reshape(-1, 2)
    shape = triangle_geometry(points, corners[:, faces])
    longest = np.sqrt(shape.squared_lengths.max(axis=0, initial=0.0))
    return faces[shape.double_area <= RESOLUTION * np.maximum(longest, RESOLUTION)]


class PlaneMap:
    """Numbers of a map whose results keep the surface, the positions, the flipped faces and a status."""

    uv: NDArray[np.float64]
    flipped: NDArray[np.int64]
    status: str
    surface: Surface

    @property
    def converged(self) -> bool:
        """Whether what was iterated, if anything was, came to its end."""
        return self.status != "max-iterations"

    @cached_property
    def conformal_energy(self) -> float:
        """Dirichlet energy minus signed area of the image; 0 where all angles are kept."""
        surface = self.surface
        kept = np.ones(surface.m, dtype=bool)
        kept[surface.degenerate] = False
        if kept.all():
            return conformal_energy(surface.geometry, self._z, surface.corners)
        geometry = triangle_geometry(surface.V, surface.corners[:, kept])
        return conformal_energy(geometry, self._z, surface.corners[:, kept])

    @property
    def dirichlet_energy(self) -> float:
        """1/2 uv' L uv, L the cotangent Laplacian; faces without area left out."""
        return self.conformal_energy + enclosed_area(self._z[self.surface.loops[0]])

    @cached_property
    def lost_to_double(self) -> NDArray[np.int64]:
        """Flipped faces whose height is within the rounding of the positions."""
        z = self._z
        return unresolved_faces(z / max(float(np.abs(z).max(initial=0.0)), 1e-300), self.surface.corners, self.flipped)

    @property
    def _z(self) -> NDArray[np.complex128]:
        return np.ascontiguousarray(self.uv).view(np.complex128).reshape(-1)
