"""Points of the circle as arcs from each to the next, spaced by what doubles tell apart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["SMALLEST_ARC", "CircleSpacing", "with_distinct_boundary"]

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]
Ints = NDArray[np.int64]

SMALLEST_ARC = 1e-15  # that neighbours on the circle keep; two doubles near 1 are told apart from 2e-16 on


class CircleSpacing:
    """Points of the circle in order, as arcs from each to the next; some of them stay where they are.

    Parameters
    ----------
    zb : (nb,) complex128
    fixed : (f,) int64
        Places in zb, ascending, at least one.
    """

    def __init__(self, zb: Complex, fixed: Ints) -> None:
        self._zb, self._fixed = zb, fixed
        self.arcs = np.maximum(np.angle(np.roll(zb, -1) / zb), 0.0)
        if not self.arcs.any():
            self.arcs += 1.0
        held = np.angle(np.roll(zb[fixed], -1) / zb[fixed]) % (2.0 * np.pi)
        # A single one: all around. It over itself is 1 only to rounding, which has told of an arc of 1e-17.
        self._stretch = np.where(held > 0.0, held, 2.0 * np.pi) if len(fixed) > 1 else np.full(1, 2.0 * np.pi)
        self.arcs = self.fitted(self.arcs)

    def shared(self, share: float) -> Real:
        """Arcs with this share of equal spacing."""
        return self.fitted((1.0 - share) * self.arcs + share * 2.0 * np.pi / len(self.arcs))

    def fitted(self, arcs: Real) -> Real:
        """Arcs scaled between each two fixed points to what lies between them."""
        first = int(self._fixed[0])
        turned = np.roll(arcs, -first)
        begin = self._fixed - first
        total = np.add.reduceat(turned, begin)
        count = np.diff(begin, append=len(arcs))
        scale = np.repeat(self._stretch / np.where(total > 0.0, total, 1.0), count)
        return np.asarray(np.roll(turned * scale, first))

    def points(self, arcs: Real) -> Complex:
        """Points with these arcs between them, the fixed ones where they were.

        Angles are summed from both sides of each fixed point, which rounds the smaller ones less.
        """
        first = int(self._fixed[0])
        out = self._zb.copy()
        begin = np.append(self._fixed, first + len(arcs))
        for start, end in zip(begin[:-1].tolist(), begin[1:].tolist(), strict=True):
            here = np.arange(start, end) % len(arcs)
            ahead = np.concatenate(([0.0], np.cumsum(arcs[here])))
            back = np.concatenate((np.cumsum(arcs[here][::-1])[::-1], [0.0]))
            near_start = ahead[:-1] <= back[:-1]
            turned = np.where(
                near_start,
                self._zb[start % len(arcs)] * np.exp(1j * ahead[:-1]),
                self._zb[end % len(arcs)] * np.exp(-1j * back[:-1]),
            )
            out[here[1:]] = (turned / np.abs(turned))[1:]
        return out


def with_distinct_boundary(z: Complex, loop: Ints, fixed: Ints) -> Complex:
    """z with neighbours on the circle that had rounded to one point moved apart by what doubles tell."""
    zb = z[loop]
    if (zb != np.roll(zb, -1)).all() and (np.angle(np.roll(zb, -1) / zb) > 0.0).all():
        return z
    boundary = CircleSpacing(zb, np.flatnonzero(np.isin(loop, fixed)))
    out = z.copy()
    out[loop] = boundary.points(boundary.fitted(np.maximum(boundary.arcs, SMALLEST_ARC)))
    return out
