"""What the Laplacian, the distortion and the checks need of each triangle, computed once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["TriangleGeometry", "triangle_geometry"]


@dataclass(frozen=True, eq=False)
class TriangleGeometry:
    """Corner products and areas of triangles, in the units of the positions squared.

    Attributes
    ----------
    dot : (3, m) float64
        Scalar product of the two edges that leave each corner; cot(angle) = dot / double_area.
    double_area : (m,) float64
        Twice the area, not negative.
    """

    dot: NDArray[np.float64]
    double_area: NDArray[np.float64]

    @property
    def squared_lengths(self) -> NDArray[np.float64]:
        """Squared length of half-edge c (corner c to c + 1), (3, m): dot_c + dot_(c+1)."""
        return self.dot + self.dot[[1, 2, 0]]


def triangle_geometry(V: NDArray[np.float64], corners: NDArray[np.int32]) -> TriangleGeometry:
    """Geometry of the triangles ``corners`` (3, m) at positions V (n, 3) or (n, 2)."""
    m = corners.shape[1]
    dot = np.zeros((3, m))
    sides: list[tuple[NDArray[np.float64], NDArray[np.float64]]] = []
    for axis in range(V.shape[1]):
        x = np.ascontiguousarray(V[:, axis])
        a, b, c = x[corners[0]], x[corners[1]], x[corners[2]]
        ab, bc, ca = b - a, c - b, a - c
        dot[0] -= ab * ca
        dot[1] -= ab * bc
        dot[2] -= bc * ca
        sides.append((ab, bc))
    if len(sides) == 2:
        (ux, vx), (uy, vy) = sides
        return TriangleGeometry(dot, np.abs(ux * vy - uy * vx))
    (ux, vx), (uy, vy), (uz, vz) = sides
    square = (uy * vz - uz * vy) ** 2
    square += (uz * vx - ux * vz) ** 2
    square += (ux * vy - uy * vx) ** 2
    return TriangleGeometry(dot, np.sqrt(square, out=square))
