"""The mean angle error of several maps of one surface, most of whose vertices lie alike: counted where they differ."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.blocks import by_blocks
from ..mesh.geometry import TriangleGeometry, triangle_geometry
from ..mesh.stars import faces_at
from ..mesh.surface import Surface
from .distortion import angle_between

__all__ = ["AngleMean"]

MOST_CHANGED = 0.2  # of the faces, up to which the difference is counted; it takes each face twice


class AngleMean:
    """In degrees over all corners, of positions in the plane.

    Parameters
    ----------
    surface : Surface
    z : (n,) complex128
        The positions that others are compared with.

    Attributes
    ----------
    first : float
        Of these positions.
    """

    def __init__(self, surface: Surface, z: NDArray[np.complex128]) -> None:
        self._surface, self._z = surface, z
        self._total = self._sum(z, None)
        self.first = self._mean(self._total)

    def of(self, z: NDArray[np.complex128], faces: NDArray[np.int64] | None = None) -> float:
        """Of other positions (n,); `faces` (k,) are those with a vertex that lies elsewhere, where they are known."""
        if z is self._z:
            return self.first
        if faces is None:
            faces = faces_at(self._surface.corners, z != self._z)
        if len(faces) > MOST_CHANGED * self._surface.m:
            return self._mean(self._sum(z, None))
        return self._mean(self._total + self._sum(z, faces) - self._sum(self._z, faces))

    def _mean(self, total: float) -> float:
        return float(np.degrees(total) / (3 * self._surface.m))

    def _sum(self, z: NDArray[np.complex128], faces: NDArray[np.int64] | None) -> float:
        """Radians over the corners of some faces, or of all."""
        points = np.ascontiguousarray(z).view(np.float64).reshape(-1, 2)
        corners, geometry = self._surface.corners, self._surface.geometry
        if faces is not None:
            corners = corners.take(faces, axis=1)
            geometry = TriangleGeometry(geometry.dot.take(faces, axis=1), geometry.double_area.take(faces))

        def turned(part: slice) -> float:
            return float(angle_between(geometry.part(part), triangle_geometry(points, corners[:, part])).sum())

        return sum(by_blocks(turned, corners.shape[1]), 0.0)
