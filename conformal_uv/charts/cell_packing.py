"""Charts packed on a grid of cells, the largest first, each into the free place that is nearest to a corner."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .footprints import Footprints
from .free_cells import NOWHERE, FreeCells, Stencil

__all__ = ["CellPlaces", "pack_cells", "stencils"]

Ints = NDArray[np.int64]

LIKE = 20.0  # charts whose sizes differ by a 20th are alike: what cells make of them is no order


@dataclass(frozen=True, eq=False)
class CellPlaces:
    """Where k charts lie: the way each is turned, and the column and row that its grid begins in."""

    way: Ints
    column: Ints
    row: Ints


def stencils(found: Footprints) -> list[Stencil]:
    """Of each chart."""
    first = np.searchsorted(found.owner, np.arange(len(found.columns) + 1))
    return [
        Stencil(found.row[a:b], found.start[a:b], found.stop[a:b], columns, rows)
        for a, b, columns, rows in zip(first[:-1], first[1:], found.columns.tolist(), found.rows.tolist(), strict=True)
    ]


def pack_cells(ways: Sequence[Sequence[Stencil]], side: int, longest_first: bool = False) -> CellPlaces | None:
    """Places in a square of `side` cells; None where charts do not fit so.

    No two charts have a cell in common. Each goes to where the square around it and the corner (0, 0) is least, and of
    such places to the lowest: charts grow around the corner, and small ones come into the bays and holes that are left.

    Parameters
    ----------
    ways : sequence of sequences of k stencils
        Each chart may lie in any of these ways.
    longest_first : bool
        The largest is the one with the longest side, not the one with the most cells.
    """
    count = len(ways[0])
    powers = np.max([[stencil.powers for stencil in way] for way in ways], axis=0)
    if longest_first:
        size = np.square([max(stencil.columns, stencil.rows) for stencil in ways[0]])
    else:
        size = np.array([(stencil.stop - stencil.start).sum() for stencil in ways[0]])
    order = np.argsort(-np.round(LIKE * np.log(size)), kind="stable")
    most = np.maximum.accumulate(powers[order][::-1])[::-1].tolist()  # of this chart and those after it
    cells, extent = FreeCells(side, most[0]), 0
    places = CellPlaces(*(np.zeros(count, dtype=np.int64) for _ in range(3)))
    for turn, chart in enumerate(order.tolist()):
        nearest, best = NOWHERE * (side + 1), None
        for number, way in enumerate(ways):
            column = cells.first_free(way[chart], extent)
            row = np.arange(len(column))
            far = np.maximum(column + way[chart].columns, row + way[chart].rows)
            reach = np.where(column < NOWHERE, far * (side + 1) + row, NOWHERE * (side + 1))
            at = int(reach.argmin()) if len(reach) else 0
            if len(reach) and reach[at] < nearest:
                nearest, best = int(reach[at]), (number, int(column[at]), at)
        if best is None:
            return None
        places.way[chart], places.column[chart], places.row[chart] = best
        stencil = ways[best[0]][chart]
        cells.fill(stencil, best[1], best[2], most[min(turn + 1, count - 1)])
        extent = max(extent, best[1] + stencil.columns, best[2] + stencil.rows)
    return places
