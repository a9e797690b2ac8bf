"""Where a closed polygon crosses itself.

Boxes around single edges, around pairs of neighbours, pairs of pairs and so on up to the whole polygon are compared
from the top: only boxes that overlap are opened. Neighbouring stretches of a polygon that hardly winds overlap hardly,
so that there are a few pairs an edge on each of the log2 (nb) levels.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["polygon_crossings"]

Complex = NDArray[np.complex128]
Ints = NDArray[np.int64]
Boxes = NDArray[np.float64]

NEAR = 1e-10  # of the polygon's extent: points so near to a line lie on it, on the outer side


def polygon_crossings(z: Complex) -> Ints:
    """Pairs of edges that cross, (c, 2), the lower number first.

    A vertex that only touches an edge from outside, and edges that lie on one another from both sides as those of a
    slit do, do not count.

    Parameters
    ----------
    z : (nb,) complex128
        Vertices; edge k goes from vertex k to the next, the inside on its left.
    """
    nb = len(z)
    first, second = _overlapping(_levels(z))
    apart = (second - first > 1) & (second - first < nb - 1)
    first, second = first[apart], second[apart]
    near = NEAR * float(np.abs(z - z[0]).max(initial=0.0))
    crossing = _parted(z, first, second, near) & _parted(z, second, first, near)
    pairs = np.column_stack((first, second))[crossing]
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


def _levels(z: Complex) -> list[Boxes]:
    """Boxes (x from, y from, -x to, -y to) (k, 4) around edges, around two, four, ... of them."""
    after = np.roll(z, -1)
    low = np.minimum(z.real, after.real), np.minimum(z.imag, after.imag)
    high = np.maximum(z.real, after.real), np.maximum(z.imag, after.imag)
    levels = [np.column_stack((*low, -high[0], -high[1]))]
    while len(levels[-1]) > 1:
        boxes = levels[-1]
        levels.append(np.minimum.reduceat(boxes, np.arange(0, len(boxes), 2)))
    return levels


def _overlapping(levels: list[Boxes]) -> tuple[Ints, Ints]:
    """Pairs of edges whose boxes overlap, the lower number first."""
    first = second = np.zeros(1, dtype=np.int64)
    for boxes in reversed(levels[:-1]):
        one = np.concatenate((2 * first, 2 * first, 2 * first + 1, 2 * first + 1))
        other = np.concatenate((2 * second, 2 * second + 1, 2 * second, 2 * second + 1))
        kept = (one <= other) & (other < len(boxes))
        one, other = one[kept], other[kept]
        overlap = (boxes[one][:, :2] <= -boxes[other][:, 2:]) & (boxes[other][:, :2] <= -boxes[one][:, 2:])
        kept = overlap.all(axis=1)
        first, second = one[kept], other[kept]
    return first, second


def _parted(z: Complex, edge: Ints, other: Ints, near: float) -> NDArray[np.bool_]:
    """Whether the line of an edge has the ends of the other on its two sides; what is near is outside."""
    nb = len(z)
    begin = z[edge]
    along = z[(edge + 1) % nb] - begin
    length = np.abs(along)
    along = along / np.where(length > 0.0, length, 1.0)
    sides = [((z[(other + k) % nb] - begin) * along.conj()).imag > near for k in (0, 1)]
    return sides[0] != sides[1]
