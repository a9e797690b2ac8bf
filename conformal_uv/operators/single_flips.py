"""Edges of an intrinsic triangulation flipped one after the other, the worst one first.

Where each flip waits for the one before, as around a fan that is undone from its end, rounds over arrays would flip an
edge each. A queue of plain numbers then costs a few microseconds a flip, and leads there by the fewest flips.
"""

from __future__ import annotations

import heapq
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .edge_flips import EPS, TOLERANCE, EdgeFlips

__all__ = ["flip_one_by_one"]


def flip_one_by_one(work: EdgeFlips, half_edges: NDArray[np.intp], most: int) -> NDArray[np.int32]:
    """Flip edges that are not Delaunay, these and what comes of them, up to so many; the half-edges left to look at."""
    one = _OneByOne(work)
    queue = [(one.excess(h), h) for h in half_edges.tolist()]
    heapq.heapify(queue)
    flips = 0
    while queue and flips < most:
        _, h = heapq.heappop(queue)
        if one.excess(h) >= 0.0:
            continue
        flips += 1
        for beside in one.flip(h):
            excess = one.excess(beside)
            if excess < 0.0:
                heapq.heappush(queue, (excess, beside))
    work.flips += flips
    left = np.array([h for _, h in queue], dtype=np.int32)
    return np.unique(np.where(work.twin.take(left) >= 0, np.minimum(left, work.twin.take(left)), left))


class _OneByOne:
    """The arrays of a triangulation, number by number."""

    def __init__(self, work: EdgeFlips) -> None:
        self._m = work.m
        self._corner, self._twin, self._touched = _numbers(work.corners), _numbers(work.twin), _numbers(work.touched)
        self._length, self._area2 = _numbers(work.lengths), _numbers(work.double_area)
        self._cot = _numbers(work.cotangents)

    def excess(self, h: int) -> float:
        """cot a + cot b of an edge that can be flipped, where that is below 0 by more than rounding; else 0."""
        m, t = self._m, self._twin[h]
        if t < 0 or h % m == t % m:
            return 0.0
        here, there = self._cot[h + 2 * m if h < m else h - m], self._cot[t + 2 * m if t < m else t - m]
        total: float = here + there
        return total if total < -TOLERANCE * (abs(here) + abs(there) + 1.0) else 0.0

    def flip(self, h: int) -> tuple[int, int, int, int]:
        """Flip one edge; the half-edges around it. Named as in EdgeFlips."""
        m, three = self._m, 3 * self._m
        corner, length, twin = self._corner, self._length, self._twin
        t = twin[h]
        f, g = h % m, t % m
        bc, ca, ad, db = (h + m) % three, (h + 2 * m) % three, (t + m) % three, (t + 2 * m) % three
        a, b, c, d = corner[h], corner[t], corner[ca], corner[db]
        l_ab, l_bc, l_ca, l_ad, l_db = length[h], length[bc], length[ca], length[ad], length[db]
        along_c = 0.5 * (l_ab + (l_ca - l_bc) * (l_ca + l_bc) / l_ab)
        along_d = 0.5 * (l_ab + (l_ad - l_db) * (l_ad + l_db) / l_ab)
        l_cd = math.hypot(along_c - along_d, (self._area2[f] + self._area2[g]) / l_ab)
        new = (f, f + m, g, g + m)
        moved = dict(zip((db, bc, ca, ad), new, strict=True))
        outside = [moved.get(beside, beside) for beside in (twin[db], twin[bc], twin[ca], twin[ad])]
        for at, beside in zip(new, outside, strict=True):
            twin[at] = beside
            if beside >= 0:
                twin[beside] = at
        twin[f + 2 * m], twin[g + 2 * m] = g + 2 * m, f + 2 * m
        self._fill(f, (d, b, c), (l_db, l_bc, l_cd))
        self._fill(g, (c, a, d), (l_ca, l_ad, l_cd))
        return new

    def _fill(self, face: int, tips: tuple[int, int, int], sides: tuple[float, float, float]) -> None:
        """A face's corners and lengths, and what follows from these."""
        m = self._m
        low, middle, high = sorted(sides)
        square = (high + (middle + low)) * (low - (high - middle)) * (low + (high - middle)) * (high + (middle - low))
        area2 = max(0.5 * math.sqrt(max(square, 0.0)), EPS * high * high)
        p, q, r = (side * side for side in sides)
        for place, (tip, side, dot) in enumerate(zip(tips, sides, (p + r - q, q + p - r, r + q - p), strict=True)):
            at = face + place * m
            self._corner[at], self._length[at], self._cot[at] = tip, side, 0.5 * dot / area2
        self._area2[face], self._touched[face] = area2, True


def _numbers(array: Any) -> Any:
    """The same memory, whose numbers are Python's."""
    return memoryview(array.reshape(-1))
