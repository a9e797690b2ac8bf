"""Charts packed on a grid of cells, by xatlas.

Of the library only whole numbers are taken: by how many cells each chart is moved. It is given runs of cells, not
positions, and what it answers is checked: no two charts may have a corner of a cell in common, so that a cell is free
between any two of them.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .footprints import Footprints

__all__ = ["pack_cells"]

Ints = NDArray[np.int64]


def pack_cells(xatlas: Any, found: Footprints, side: int | None = None) -> tuple[Ints, Ints] | None:
    """Columns and rows (k,) by which charts are moved, into a square of `side` cells if given.

    None where they do not fit, as the library goes about it.
    """
    if side is None:
        column, row = _moved(xatlas, found)
        return (column, row) if _apart(found, column, row) else None
    framed = found.with_frame(side)
    column, row = _moved(xatlas, framed)
    if column[-1] or row[-1] or not _apart(framed, column, row):
        return None
    column, row = column[:-1], row[:-1]
    inside = max((column + found.columns).max(), (row + found.rows).max()) <= side
    return (column, row) if inside else None


def _moved(xatlas: Any, found: Footprints) -> tuple[Ints, Ints]:
    """Columns and rows (k,) by which the library moves the charts."""
    shift = np.cumsum(found.columns + 2) - found.columns  # charts are told apart by having no corner in common
    triangles, owner = _triangles(found)
    x = np.stack((found.start, found.stop, found.stop, found.start), axis=1) + shift[found.owner, None]
    y = found.row[:, None] + [0, 0, 1, 1]
    corners = np.stack((x, y), axis=2).reshape(-1, 2)
    atlas, options = xatlas.Atlas(), xatlas.PackOptions()
    options.rotate_charts = options.rotate_charts_to_axis = options.bilinear = False
    options.texels_per_unit, options.padding, options.resolution, options.bruteForce = 1.0, 0, 0, True
    atlas.add_uv_mesh(corners.astype(np.float32), triangles.astype(np.uint32), owner.astype(np.uint32)[:, None])
    atlas.generate(xatlas.ChartOptions(), options)
    vertex, _, uv = atlas[0]
    moved = np.zeros(corners.shape)
    moved[vertex] = uv.astype(np.float64) * [atlas.width, atlas.height] - 0.5  # centres of cells
    one = 4 * np.searchsorted(found.owner, np.arange(len(shift)))  # corner of each chart
    offset = np.rint(moved[one] - corners[one]).astype(np.int64)
    return offset[:, 0] + shift, offset[:, 1]


def _triangles(found: Footprints) -> tuple[Ints, Ints]:
    """The runs as two triangles each, and links that make one chart of its runs: (m, 3) corners, (m,) charts.

    Corner 4 i + (0, 1, 2, 3) is one of run i: below left, below right, above right, above left. A link lies in a run
    and has a corner of it and one of a run in the next row.
    """
    run = 4 * np.arange(len(found.owner))
    lower, upper = _touching(found)
    further = found.start[upper] >= found.start[lower]
    one, other = 4 * lower, 4 * upper
    in_lower = np.stack((other, one + 3, one), axis=1)[further]
    in_upper = np.stack((one + 3, other, other + 3), axis=1)[~further]
    halves = (run[:, None] + [0, 1, 2], run[:, None] + [0, 2, 3])
    triangles = np.concatenate((*halves, in_lower, in_upper))
    return triangles, found.owner[triangles[:, 0] // 4]


def _touching(found: Footprints) -> tuple[Ints, Ints]:
    """Pairs of runs in neighbouring rows of a chart that have a corner of a cell in common, the lower one first."""
    stride = found.columns + 2
    first = np.cumsum(stride * (found.rows + 1)) - stride * (found.rows + 1)
    begin = first[found.owner] + found.row * stride[found.owner] + found.start
    end = begin + found.stop - found.start
    above = stride[found.owner]
    left = np.searchsorted(end, begin + above, side="left")
    count = np.maximum(np.searchsorted(begin, end + above, side="right") - left, 0)
    lower = np.repeat(np.arange(len(begin)), count)
    return lower, np.arange(count.sum()) - np.repeat(np.cumsum(count) - count - left, count)


def _apart(found: Footprints, column: Ints, row: Ints) -> bool:
    """Whether no two charts have a corner of a cell in common, and none lies outside."""
    if min(column.min(), row.min()) < 0:
        return False
    stride = int((column + found.columns).max()) + 1
    start = (row[found.owner] + found.row) * stride + column[found.owner] + found.start
    length = np.tile(found.stop - found.start + 1, 2)
    start, owner = np.concatenate((start, start + stride)), np.tile(found.owner, 2)
    corner = np.arange(length.sum()) + np.repeat(start - np.cumsum(length) + length, length)
    owner = np.repeat(owner, length)
    holder = np.empty(int(corner.max()) + 1, dtype=np.int64)
    holder[corner] = owner
    return bool(np.array_equal(holder[corner], owner))
