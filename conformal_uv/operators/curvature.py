"""How a surface is curved at its vertices: angle defects inside, turning angles along the boundary."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.surface import Surface
from .laplacian import intrinsic_geometry
from .mollification import mollified

__all__ = ["corner_angles", "curvatures"]

Real = NDArray[np.float64]


def corner_angles(surface: Surface) -> Real:
    """Angle of every corner, (3, m) radians, of sum pi in each face.

    Faces without area have the angles of the mollified lengths, as their Laplacian has.
    """
    geometry = surface.geometry
    angles = np.arctan2(geometry.double_area, geometry.dot)
    if len(geometry.degenerate):
        safe = mollified(np.sqrt(np.maximum(geometry.squared_lengths, 0.0)))
        shape = intrinsic_geometry(safe[:, geometry.degenerate])
        angles[:, geometry.degenerate] = np.arctan2(shape.double_area, shape.dot)
    return angles


def curvatures(surface: Surface, loop: NDArray[np.int64]) -> Real:
    """2 pi less the sum of the angles at interior vertices, pi less that sum on the boundary, (n,); 2 pi in all."""
    total = np.bincount(surface.corners.reshape(-1), corner_angles(surface).reshape(-1), surface.n)
    out = 2.0 * np.pi - total
    out[loop] = np.pi - total[loop]
    return out
