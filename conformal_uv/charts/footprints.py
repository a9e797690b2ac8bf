"""The cells of a square grid that charts cover, with some distance around them; never too few of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .outlines import Outlines

__all__ = ["Footprints", "footprints"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]

ROWS_AT_ONCE = 1_000_000  # of triangles: bounds the memory
CELLS_AT_ONCE = 1 << 22  # of all charts' grids, likewise
ROUNDING = 1e-9  # of a cell; positions are rounded to far less


@dataclass(frozen=True, eq=False)
class Footprints:
    """Runs of covered cells, chart after chart, row after row from below, left to right.

    Attributes
    ----------
    owner, row, start, stop : (r,) int64
        The chart of each run, its row, its first cell and the first one behind it.
    columns, rows : (k,) int64
        Of each chart's grid; the chart's box begins `around` cells inside.
    around : float
    """

    owner: Ints
    row: Ints
    start: Ints
    stop: Ints
    columns: Ints
    rows: Ints
    around: float


def footprints(outlines: Outlines, cell: float, around: float) -> Footprints:
    """Cells of side `cell` with a point that is less than `around` cells to the side of and above the chart's."""
    columns, rows = (
        np.ceil(size / cell + 2.0 * (around + ROUNDING)).astype(np.int64)
        for size in (outlines.size.real, outlines.size.imag)
    )
    batch = np.cumsum((columns + 1) * rows) // CELLS_AT_ONCE
    parts = (
        [_footprints(outlines, cell, around, columns, rows)]
        if batch[-1] == batch[0]
        else [
            _footprints(outlines.chosen(batch == one), cell, around, columns[batch == one], rows[batch == one])
            for one in np.unique(batch)
        ]
    )
    return _joined(parts)


def _joined(parts: list[Footprints]) -> Footprints:
    before = np.cumsum([0] + [len(part.columns) for part in parts])
    owner = np.concatenate([part.owner + count for part, count in zip(parts, before, strict=False)])
    row, start, stop, columns, rows = (
        np.concatenate([getattr(part, name) for part in parts]) for name in ("row", "start", "stop", "columns", "rows")
    )
    return Footprints(owner, row, start, stop, columns, rows, parts[0].around)


def _footprints(outlines: Outlines, cell: float, around: float, columns: Ints, rows: Ints) -> Footprints:
    around = around + ROUNDING
    stride = columns + 1  # a free cell ends each row
    first = np.concatenate(([0], np.cumsum(stride * rows)))
    change = np.zeros(first[-1] + 1, dtype=np.int64)
    z = outlines.z / cell + around * (1 + 1j)
    for triangle, row in _triangle_rows(z.imag, outlines, rows, around):
        left, right = _ranges(z[outlines.corners[:, triangle]], row, around)
        chart = outlines.owner[triangle]
        begin = first[chart] + row * stride[chart]
        start = np.clip(np.floor(left).astype(np.int64), 0, columns[chart] - 1)
        stop = np.clip(np.floor(right).astype(np.int64), start, columns[chart] - 1) + 1
        change += np.bincount(begin + start, minlength=len(change)) - np.bincount(begin + stop, minlength=len(change))
    covered = np.cumsum(change) > 0
    edge = np.flatnonzero(np.diff(covered, prepend=False, append=False))
    start, stop = edge[::2], edge[1::2]
    owner = np.searchsorted(first, start, side="right") - 1
    row, column = np.divmod(start - first[owner], stride[owner])
    return Footprints(owner, row, column, column + stop - start, columns, rows, around)


def _triangle_rows(y: Real, outlines: Outlines, rows: Ints, around: float) -> Iterator[tuple[Ints, Ints]]:
    """Every pair of a triangle and a row that it comes near, in batches."""
    height = y[outlines.corners]
    most = rows[outlines.owner] - 1
    below = np.clip(np.floor(height.min(axis=0) - around).astype(np.int64), 0, most)
    above = np.clip(np.floor(height.max(axis=0) + around).astype(np.int64), below, most)
    count = above - below + 1
    batch = np.cumsum(count) // ROWS_AT_ONCE
    for taken in np.split(np.arange(len(count)), np.flatnonzero(np.diff(batch)) + 1):
        own = count[taken]
        row = np.arange(own.sum()) - np.repeat(np.cumsum(own) - own - below[taken], own)
        yield np.repeat(taken, own), row


def _ranges(z: NDArray[np.complex128], row: Ints, around: float) -> tuple[Real, Real]:
    """From where to where triangles (3, r) reach in the rows (r,), with `around` on all sides."""
    low, high = row - around, row + 1.0 + around
    left, right = np.full(len(row), np.inf), np.full(len(row), -np.inf)
    for here, there in zip(z, np.roll(z, -1, axis=0), strict=True):
        step = there - here
        flat = np.abs(step.imag) < ROUNDING**2
        slope = np.divide(1.0, step.imag, out=np.zeros(len(row)), where=~flat)
        one, other = (low - here.imag) * slope, (high - here.imag) * slope
        begin = np.where(flat, 0.0, np.clip(np.minimum(one, other), 0.0, 1.0))
        end = np.where(flat, 1.0, np.clip(np.maximum(one, other), 0.0, 1.0))
        outside = (np.maximum(here.imag, there.imag) < low) | (np.minimum(here.imag, there.imag) > high)
        one, other = here.real + begin * step.real, here.real + end * step.real
        left = np.minimum(left, np.where(outside, np.inf, np.minimum(one, other)))
        right = np.maximum(right, np.where(outside, -np.inf, np.maximum(one, other)))
    return left - around, right + around
