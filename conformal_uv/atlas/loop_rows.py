"""Boundary loops with the same number of vertices as the rows of one array."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["LoopRows", "loop_rows"]

Ints = NDArray[np.int64]

MOST_ENTRIES = 1 << 16  # of the square matrices of all rows, which then stay in the processor's cache


class LoopRows(NamedTuple):
    """Some disks whose boundaries have nb vertices.

    `disk` (r,) are the disks, `at` (r, nb) the places of their boundary vertices among those of all disks.
    """

    disk: Ints
    at: Ints


def loop_rows(first_boundary: Ints, chosen: Ints | None = None) -> Iterator[LoopRows]:
    """The disks, or some of them, by the number of their boundary vertices, in ascending order.

    Parameters
    ----------
    first_boundary : (c + 1,) int64
        Where each boundary begins.
    chosen : (k,) int64, ascending, optional
    """
    disks = np.arange(len(first_boundary) - 1) if chosen is None else chosen
    count = np.diff(first_boundary)[disks]
    for nb in np.unique(count).tolist():
        same, step = disks[count == nb], max(MOST_ENTRIES // nb**2, 1)
        for start in range(0, len(same), step):
            disk = same[start : start + step]
            yield LoopRows(disk, first_boundary[disk][:, None] + np.arange(nb))
