"""A fill-reducing order of a surface's vertices, from their positions: nested dissection.

A. George, "Nested dissection of a regular finite element mesh", 1973: vertices that part a mesh in two are eliminated
after both parts, and so on within each part. Here the parts are those of a k-d tree over the positions (cut in the
middle across the longer extent), and all its separators come out at once. With the cells of the tree numbered so that
each bit tells a side of a cut, an edge is cut where the numbers of its ends first differ, so a vertex separates its
cell as soon as some neighbour has a number that differs there and is larger. The first cuts, where most of the work of
an elimination is, are covered by as few vertices as possible, of both sides: D. Koenig, "Gráfok és mátrixok", 1931.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order, maximum_bipartite_matching

from ..threads import side_by_side

__all__ = ["nested_dissection"]

Index = NDArray[np.int32]
Cells = NDArray[np.int64]

BLOCK = 1 << 15  # vertices; three numbers for each stay in the cache
LEAF = 16  # vertices of a cell that is not cut any further
SAMPLES = 16  # vertices of a cell, about, that tell where to cut it
FEW = 1024  # cells
RESOLUTION = 30  # bits of a coordinate
MOST_LEVELS = 30  # so that numbers of cells fit into 32 bits
COVERED = 1 << 14  # vertices of a cell, from which on as few as possible are found to separate it
WORST = 30.0  # work of the elimination, over that of cells of n vertices being cut by sqrt(n)


def nested_dissection(points: NDArray[np.float64], indices: Index, indptr: NDArray[np.integer]) -> Index | None:
    """An order in which to eliminate the vertices of a mesh.

    Parameters
    ----------
    points : (n, d) float64
        Positions of the vertices, finite.
    indices, indptr
        Pattern of the lower triangle of the mesh's matrix in CSC form, diagonal included.

    Returns
    -------
    (n,) int32, the vertices in their order; None where the positions tell too little of the mesh to part it well.
    """
    n = len(points)
    levels = min(max(int(n / LEAF).bit_length(), 0), MOST_LEVELS)
    if levels == 0:
        return np.arange(n, dtype=np.int32)
    cell = _cells(points, levels)
    # Bits, counted from 1, at which a vertex separates; 0 for those inside a leaf.
    level = _first_separators(cell, levels, indices, indptr)
    first = level > 0
    highest = _highest_neighbour(np.where(first, -1, cell), indices, indptr)
    later = np.frexp((cell ^ np.maximum(highest, cell)).astype(np.float64))[1].astype(np.int64)
    level = np.where(first, level, later)
    # A separator comes after the last vertex of the cell that it parts, and after finer ones that end there too.
    last = cell | ((np.int64(1) << level) - 1)
    key = (last << 5) | level
    bits = np.int64(
        n.bit_length()
    )  # vertices of a key in their order; plain numbers are sorted much faster than places
    key <<= bits
    key |= np.arange(n)
    key.sort()
    order = (key & ((np.int64(1) << bits) - 1)).astype(np.int32)
    key >>= bits
    return order if _work(key, n) < WORST else None


def _cells(points: NDArray[np.float64], levels: int) -> Cells:
    """Number of the cell of each point, one bit for each cut, the first cut the highest."""
    n = len(points)
    columns = np.ascontiguousarray(points.T)
    low = columns.min(axis=1, keepdims=True)
    extent = float((columns.max(axis=1, keepdims=True) - low).max()) or 1.0
    columns -= low
    columns *= (2**RESOLUTION - 1) / extent
    grid = columns.astype(np.int32)
    flat, here = grid.reshape(-1), np.arange(n)
    cell = np.zeros(n, dtype=np.int64)
    step = max(int(0.6180339887 * n), 1) | 1
    for level in range(levels):
        count = SAMPLES << level
        chosen = here if count >= n else (np.arange(count) * step) % n  # spread evenly, in step with no grid
        axis, middle = _cuts(grid.take(chosen, axis=1), cell.take(chosen), 1 << level)
        _descend(cell, flat, axis * n, middle)
    return cell


def _descend(cell: Cells, flat: NDArray[np.int32], start: NDArray[np.int64], middle: NDArray[np.int32]) -> None:
    """From each cell into one of its halves, by the coordinate that begins at `start` in all coordinates."""

    def halve(begin: int) -> None:
        here = cell[begin : begin + BLOCK]
        place = start.take(here)
        place += np.arange(begin, begin + len(here))
        beyond = flat.take(place) > middle.take(here)
        here <<= 1
        here += beyond

    side_by_side(halve, range(0, len(cell), BLOCK))


def _cuts(grid: NDArray[np.int32], cell: Cells, cells: int) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """For each cell the axis of widest spread, and where to cut it.

    That is the median while cells are few; the mean, which is as good where the vertices have become evenly spread
    and needs no sort, when they are many.
    """
    count = np.bincount(cell, minlength=cells)
    share = 1.0 / np.maximum(count, 1)
    spread, mean = np.empty((len(grid), cells)), np.empty((len(grid), cells))
    for axis, x in enumerate(grid.astype(np.float64)):
        mean[axis] = share * np.bincount(cell, weights=x, minlength=cells)
        x -= mean[axis].take(cell)
        spread[axis] = np.bincount(cell, weights=np.abs(x, out=x), minlength=cells)
    widest = np.argmax(spread, axis=0)
    if cells > FEW:
        return widest, mean[widest, np.arange(cells)].astype(np.int32)
    key = grid.reshape(-1).take((widest * len(cell)).take(cell) + np.arange(len(cell)))
    key = (cell << RESOLUTION) | key
    key.sort()
    middle = np.cumsum(count) - count + count // 2
    median = key.take(middle, mode="clip") & ((1 << RESOLUTION) - 1)
    return widest, np.where(count > 0, median, 0).astype(np.int32)


def _first_separators(cell: Cells, levels: int, indices: Index, indptr: NDArray[np.integer]) -> Cells:
    """At which of the first cuts each vertex separates, (n,), the bit counted from 1; 0 for most."""
    found = np.zeros(len(cell), dtype=np.int64)
    last = max(levels - (len(cell) // COVERED).bit_length(), 0)
    if last == levels:
        return found
    column = np.repeat(np.arange(len(cell), dtype=np.int32), np.diff(indptr))
    differ = cell.take(indices) ^ cell.take(column)
    cut = np.flatnonzero(differ >= np.int64(1) << last)
    i, j, bit = indices.take(cut), column.take(cut), np.frexp(differ.take(cut).astype(np.float64))[1]
    for level in range(levels, last, -1):
        here = (bit == level) & (found.take(i) == 0) & (found.take(j) == 0)
        a, b = i[here], j[here]
        lower = (cell.take(a) >> (level - 1)) & 1 == 0
        found[_least_cover(np.where(lower, a, b), np.where(lower, b, a))] = level
    return found


def _least_cover(one: Index, other: Index) -> Index:
    """The fewest vertices that every edge from `one` side to the `other` has one of."""
    rows, i = np.unique(one, return_inverse=True)
    columns, j = np.unique(other, return_inverse=True)
    m, k = len(rows), len(columns)
    match = maximum_bipartite_matching(csr_array((np.ones(len(i), np.int8), (i, j)), shape=(m, k)), "column")
    matched, free = np.flatnonzero(match >= 0), np.flatnonzero(match < 0)
    # What is reached from free vertices along edges of which every second one is matched.
    source = np.concatenate((i, m + match[matched], np.full(len(free), m + k)))
    target = np.concatenate((m + j, matched, free))
    ways = csr_array((np.ones(len(source), np.int8), (source, target)), shape=(m + k + 1, m + k + 1))
    reached = np.zeros(m + k + 1, dtype=bool)
    reached[breadth_first_order(ways, m + k, return_predecessors=False)] = True
    return np.concatenate((rows[~reached[:m]], columns[reached[m:-1]]))


def _highest_neighbour(cell: Cells, indices: Index, indptr: NDArray[np.integer]) -> Cells:
    """The largest cell number among each vertex and its neighbours."""
    highest = np.maximum.reduceat(cell.take(indices), indptr[:-1])
    np.maximum.at(highest, indices, np.repeat(cell, np.diff(indptr)))
    return highest


def _work(key: NDArray[np.int64], n: int) -> float:
    """Sum of the cubes of the separators' sizes, over n^(3/2)."""
    start = np.flatnonzero(np.diff(key, prepend=-1))
    size = np.diff(start, append=n).astype(np.float64)
    return float((size**3).sum()) / n**1.5
