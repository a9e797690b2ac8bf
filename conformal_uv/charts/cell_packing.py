"""Charts packed on a grid of cells, as blocks fall in a well known game: each comes to rest on what lies there already.

B. Levy, S. Petitjean, N. Ray, J. Maillot, "Least squares conformal maps for automatic texture atlas generation",
SIGGRAPH 2002, section 4.2. No two charts have a corner of a cell in common, so that a cell is free between any two.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .footprints import Footprints

__all__ = ["pack_cells"]

Ints = NDArray[np.int64]


def pack_cells(found: Footprints, side: int) -> tuple[Ints, Ints] | None:
    """Columns and rows (k,) by which charts are moved into a square of `side` cells; None where they do not fit so.

    The highest go first, each to where its top comes lowest, and of these places to where it leaves the least room
    below.
    """
    first, bottom, top = _profiles(found)
    free = np.zeros(side + 1, dtype=np.int64)  # the lowest free row of corners, in each column of corners
    column, row = np.zeros(len(found.columns), dtype=np.int64), np.zeros(len(found.columns), dtype=np.int64)
    for chart in np.lexsort((-found.columns, -found.rows)).tolist():
        here = slice(first[chart], first[chart + 1])
        width = first[chart + 1] - first[chart]
        if width > side + 1:
            return None
        under = np.lib.stride_tricks.sliding_window_view(free, width)
        rest = np.maximum((under - bottom[here]).max(axis=1), 0)
        lowest = np.flatnonzero(rest == rest.min())
        left = (rest[lowest, None] + bottom[here] - under[lowest]).sum(axis=1)
        at = int(lowest[np.argmin(left)])
        column[chart], row[chart] = at, rest[at]
        if row[chart] + found.rows[chart] > side:
            return None
        np.maximum(free[at : at + width], row[chart] + top[here] + 1, out=free[at : at + width])
    return column, row


def _profiles(found: Footprints) -> tuple[Ints, Ints, Ints]:
    """Lowest and highest row of corners in each column of corners, chart after chart, and where each chart begins.

    Every column between a chart's first and last is covered, for its runs hang together.
    """
    first = np.concatenate(([0], np.cumsum(found.columns + 1)))
    length = found.stop - found.start + 1
    begin = first[found.owner] + found.start
    place = np.arange(length.sum()) + np.repeat(begin - np.cumsum(length) + length, length)
    bottom, top = np.full(first[-1], np.iinfo(np.int32).max, dtype=np.int64), np.full(first[-1], -1, dtype=np.int64)
    np.minimum.at(bottom, place, np.repeat(found.row, length))
    np.maximum.at(top, place, np.repeat(found.row + 1, length))
    return first, bottom, top
