"""Boxes laid on shelves: from high to low, side by side as long as there is room, then on the next shelf.

With very many small boxes this wastes next to nothing, and a hundred thousand of them take no time.
"""

from __future__ import annotations

from bisect import bisect_right

import numpy as np
from numpy.typing import NDArray

__all__ = ["blocks_of_shelves", "square_of_shelves"]

Complex = NDArray[np.complex128]
Ints = NDArray[np.int64]

BISECTIONS = 24


def square_of_shelves(size: Complex) -> tuple[Complex, float]:
    """Lower left corners of boxes (k,) in a square, and its side."""
    order = _from_high_to_low(size)
    end, height = np.cumsum(size.real[order]).tolist(), size.imag[order]
    least = max(float(np.sqrt((size.real * size.imag).sum())), float(size.real.max()), float(height[0]))
    narrow, wide = least, 2.0 * least
    while float(height[_full(end, wide)].sum()) > wide:
        narrow, wide = wide, 2.0 * wide
    for _ in range(BISECTIONS):
        middle = 0.5 * (narrow + wide)
        narrow, wide = (narrow, middle) if float(height[_full(end, middle)].sum()) <= middle else (middle, wide)
    starts = np.array(_full(end, wide))
    place = np.empty(len(size), dtype=np.complex128)
    up = np.cumsum(height[starts]) - height[starts]
    count = np.diff(np.append(starts, len(size)))
    place[order] = _along(size.real[order], starts) + 1j * np.repeat(up, count)
    return place, max(float((place.real + size.real).max()), float((place.imag + size.imag).max()))


def blocks_of_shelves(size: Complex, side: float) -> tuple[Complex, Ints, Complex]:
    """Boxes in blocks of about this side: corners (k,) in their blocks, the block of each (k,), sizes of the blocks."""
    order = _from_high_to_low(size)
    starts = np.array(_full(np.cumsum(size.real[order]).tolist(), side))
    height = size.imag[order[starts]]
    first = np.array(_full(np.cumsum(height).tolist(), side))
    count = np.diff(np.append(starts, len(order)))
    place, block = np.empty(len(size), dtype=np.complex128), np.empty(len(size), dtype=np.int64)
    up = _along(height, first)
    place[order] = _along(size.real[order], starts) + 1j * np.repeat(up, count)
    of_shelf = np.repeat(np.arange(len(first)), np.diff(np.append(first, len(starts))))
    block[order] = np.repeat(of_shelf, count)
    begin = starts[first]
    far = (place + size)[order]
    return place, block, np.maximum.reduceat(far.real, begin) + 1j * np.maximum.reduceat(far.imag, begin)


def _from_high_to_low(size: Complex) -> Ints:
    return np.lexsort((-size.real, -size.imag))


def _full(end: list[float], room: float) -> list[int]:
    """Where shelves begin, by the running sum of lengths (k,): a step for each shelf, not for each length.

    What is longer than there is room stands alone.
    """
    starts, here, before = [], 0, 0.0
    while here < len(end):
        starts.append(here)
        here = max(here + 1, bisect_right(end, before + room, here))
        before = end[here - 1]
    return starts


def _along(length: NDArray[np.float64], starts: Ints) -> NDArray[np.float64]:
    """How far from its shelf's beginning each of the lengths (k,) begins."""
    begin = np.cumsum(length) - length
    return begin - np.repeat(begin[starts], np.diff(np.append(starts, len(length))))
