"""What the Laplacian, the distortion and the checks need of each triangle, computed once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..concise import Concise
from .blocks import by_blocks

__all__ = ["TriangleGeometry", "triangle_geometry"]

Real = NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class TriangleGeometry(Concise):
    """Corner products and areas of triangles, in the units of the positions squared.

    Attributes
    ----------
    dot : (3, m) float64
        Scalar product of the two edges that leave each corner; cot(angle) = dot / double_area.
    double_area : (m,) float64
        Twice the area, not negative.
    """

    dot: Real
    double_area: Real

    def part(self, faces: slice) -> TriangleGeometry:
        """That of a range of the faces."""
        return TriangleGeometry(self.dot[:, faces], self.double_area[faces])

    @property
    def squared_lengths(self) -> Real:
        """Squared length of half-edge c (corner c to c + 1), (3, m): dot_c + dot_(c+1)."""
        return np.stack([self.dot[c] + self.dot[c - 2] for c in range(3)])

    def side_lengths(self) -> Real:
        """Length of half-edge c, (3, m); 0 where rounding has made the square negative."""
        lengths = np.empty_like(self.dot)

        def fill(part: slice) -> None:
            a, b, c = self.dot[:, part]
            for row, (one, other) in zip(lengths, ((a, b), (b, c), (c, a)), strict=True):
                np.add(one, other, out=row[part])
            np.maximum(lengths[:, part], 0.0, out=lengths[:, part])
            np.sqrt(lengths[:, part], out=lengths[:, part])

        by_blocks(fill, len(self.double_area))
        return lengths

    def cotangents(self) -> Real:
        """Cotangent of each corner's angle, (3, m), of triangles that all have area."""
        out = np.empty_like(self.dot)
        by_blocks(
            lambda part: np.divide(self.dot[:, part], self.double_area[part], out=out[:, part]), len(self.double_area)
        )
        return out

    @cached_property
    def degenerate(self) -> NDArray[np.int64]:
        """Faces whose area is lost to rounding: twice the area at most 8 eps times the longest edge squared, (k,).

        The cross product of two edges is wrong by a few eps times the product of their lengths, so below that the
        sign and size of the cotangents carry no information.
        """

        def found(part: slice) -> NDArray[np.int64]:
            a, b, c = self.dot[:, part]
            longest = a + b
            np.maximum(longest, b + c, out=longest)
            np.maximum(longest, c + a, out=longest)
            longest *= 8.0 * np.finfo(np.float64).eps
            return part.start + np.flatnonzero(self.double_area[part] <= longest)

        return np.concatenate(by_blocks(found, len(self.double_area)) or [np.empty(0, dtype=np.int64)])


def triangle_geometry(V: NDArray[np.float64], corners: NDArray[np.int32]) -> TriangleGeometry:
    """Geometry of the triangles ``corners`` (3, m) at positions V (n, 3) or (n, 2)."""
    m = corners.shape[1]
    dot, double_area = np.empty((3, m)), np.empty(m)
    columns = np.ascontiguousarray(V.T)

    def measure(part: slice) -> None:
        here = corners[:, part].astype(np.intp)
        sides = []
        total = np.zeros((3, here.shape[1]))
        for column in columns:
            a, b, c = column.take(here)
            ab, bc, ca = b - a, c - b, a - c
            total[0] -= ab * ca
            total[1] -= ab * bc
            total[2] -= bc * ca
            sides.append((ab, bc))
        dot[:, part] = total
        double_area[part] = _cross_length(sides)

    by_blocks(measure, m)
    return TriangleGeometry(dot, double_area)


def _cross_length(sides: list[tuple[Real, Real]]) -> Real:
    """Length of the cross product of two edges, given axis by axis."""
    if len(sides) == 2:
        (ux, vx), (uy, vy) = sides
        return np.abs(ux * vy - uy * vx)
    (ux, vx), (uy, vy), (uz, vz) = sides
    square = (uy * vz - uz * vy) ** 2
    square += (uz * vx - ux * vz) ** 2
    square += (ux * vy - uy * vx) ** 2
    return np.sqrt(square, out=square)
