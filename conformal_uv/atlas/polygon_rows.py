"""Many closed polygons with the same number of vertices, a row each.

As `free.polygon` and `operators.polygon_crossings` have them of one.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..free.polygon import MOST_STEPS, ROUNDING, SHORTEST_STEP, WIDEST_GAP
from ..operators.polygon_crossings import NEAR

__all__ = ["closed_rows", "crossing_rows"]

Real = NDArray[np.float64]
Bools = NDArray[np.bool_]
Complex = NDArray[np.complex128]


def closed_rows(turning: Real, wanted: Real) -> tuple[Complex, Bools]:
    """Vertices (r, nb) of polygons by their turning angles and wanted lengths, and which rows (r,) can be closed.

    As `free.polygon.closed_polygon`, row by row.
    """
    headings = np.concatenate((np.zeros((len(turning), 1)), np.cumsum(turning[:, 1:], axis=1)), axis=1)
    around = np.sort(headings % (2.0 * np.pi), axis=1)
    widest = np.diff(around, axis=1, append=around[:, :1] + 2.0 * np.pi).max(axis=1)
    closed = widest <= WIDEST_GAP
    lengths = wanted.copy()
    lengths[closed] = _closing_rows(headings[closed], wanted[closed])
    sides = lengths * np.exp(1j * headings)
    return np.concatenate((np.zeros((len(turning), 1)), np.cumsum(sides, axis=1)[:, :-1]), axis=1), closed


def _closing_rows(headings: Real, wanted: Real) -> Real:
    """Lengths (r, nb) of edges that add up to 0 in each row; Newton's steps of a row end as they would alone."""
    way = np.stack((np.cos(headings), np.sin(headings)), axis=1)
    x, lengths, total = np.zeros((len(wanted), 2)), wanted.copy(), wanted.sum(axis=1)
    active = np.arange(len(wanted))
    for _ in range(MOST_STEPS):
        slope = np.einsum("rck,rk->rc", way[active], lengths[active])
        open_still = np.linalg.norm(slope, axis=1) > ROUNDING * total[active]
        active, slope = active[open_still], slope[open_still]
        if not len(active):
            break
        ways, here = way[active], lengths[active]
        step = np.linalg.solve((ways * here[:, None, :]) @ ways.transpose(0, 2, 1), slope[:, :, None])[:, :, 0]
        part = np.minimum(1.0, 2.0 / np.linalg.norm(step, axis=1))
        highest = here.sum(axis=1) + ROUNDING * total[active]
        while True:
            there = wanted[active] * np.exp(-np.einsum("rc,rck->rk", x[active] + part[:, None] * step, ways))
            high = (there.sum(axis=1) > highest) & (part > SHORTEST_STEP)
            if not high.any():
                break
            part[high] *= 0.5
        moved = part > SHORTEST_STEP
        active = active[moved]
        x[active] += part[moved, None] * step[moved]
        lengths[active] = there[moved]
    return lengths


def crossing_rows(z: Complex) -> Bools:
    """Which of the polygons (r, nb) cross themselves, (r,); every edge is compared with every other."""
    nb = z.shape[1]
    along = np.roll(z, -1, axis=1) - z
    length = np.abs(along)
    along = along / np.where(length > 0.0, length, 1.0)
    near = NEAR * np.abs(z - z[:, :1]).max(axis=1)
    beside = np.imag((z[:, None, :] - z[:, :, None]) * np.conj(along)[:, :, None]) > near[:, None, None]
    parted = beside != np.roll(beside, -1, axis=2)  # by the line of the first edge
    k = np.arange(nb)
    apart = (k - k[:, None] > 1) & (k - k[:, None] < nb - 1)
    return (parted & parted.transpose(0, 2, 1) & apart).any(axis=(1, 2))
