"""Closed polygons of given turning angles, with edges as long as they may be.

The edges' directions are the running sums of the turning angles. Lengths close the polygon when the edges add up to
0; of all that do, those are taken that differ least from the wanted ones, ``sum l log(l / wanted) - l + wanted``. To
second order this is ``sum (l - wanted)^2 / (2 wanted)``, the change of R. Sawhney, K. Crane, "Boundary first
flattening", 2017, section 4.3, but no length ever becomes negative: ``l = wanted exp(-direction . x)``, where x
minimises the convex function ``sum l``.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["closed_polygon", "closing_lengths"]

Real = NDArray[np.float64]

ROUNDING = 4.0 * np.finfo(np.float64).eps
MOST_STEPS = 60
SHORTEST_STEP = 2.0**-40
WIDEST_GAP = np.pi - 1e-3  # between directions; lengths that close a polygon with a wider one are out of all proportion


def closed_polygon(turning: Real, wanted: Real) -> NDArray[np.complex128] | None:
    """Vertices of the polygon, the first at 0 and its edge along the real axis; None where no lengths close it.

    Parameters
    ----------
    turning : (nb,) float64
        Exterior angle at each vertex, radians; the sum is 2 pi.
    wanted : (nb,) float64
        Length of the edge from each vertex to the next, positive.
    """
    headings = np.concatenate(([0.0], np.cumsum(turning[1:])))
    lengths = closing_lengths(headings, wanted)
    if lengths is None:
        return None
    return np.concatenate(([0.0], np.cumsum(lengths * np.exp(1j * headings))[:-1]))


def closing_lengths(headings: Real, wanted: Real) -> Real | None:
    """Lengths of edges with these headings that add up to 0; None where there are none in any proportion."""
    way = np.stack((np.cos(headings), np.sin(headings)))
    if _widest_gap(headings) > WIDEST_GAP:
        return None
    x, lengths = np.zeros(2), wanted
    total = float(wanted.sum())
    for _ in range(MOST_STEPS):
        slope = way @ lengths
        if np.linalg.norm(slope) <= ROUNDING * total:
            break
        step = np.linalg.solve((way * lengths) @ way.T, slope)
        part = min(1.0, 2.0 / float(np.linalg.norm(step)))
        highest = lengths.sum() + ROUNDING * total  # near the minimum sums are equal but for rounding
        while (there := wanted * np.exp(-(x + part * step) @ way)).sum() > highest and part > SHORTEST_STEP:
            part *= 0.5
        if part <= SHORTEST_STEP:  # down to rounding
            break
        x, lengths = x + part * step, there
    return lengths


def _widest_gap(headings: Real) -> float:
    """The largest angle between neighbours of some directions."""
    around = np.sort(headings % (2.0 * np.pi))
    return float(np.diff(around, append=around[0] + 2.0 * np.pi).max())
