"""Loose triangles joined where corners have exactly the same position."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["welded"]


def welded(soup: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Positions in order of appearance, and the index of each corner among them. NaN equals nothing."""
    order = np.lexsort((soup[:, 2], soup[:, 1], soup[:, 0]))
    rows = soup[order]
    new = np.ones(len(rows), dtype=bool)
    new[1:] = (rows[1:] != rows[:-1]).any(axis=1)
    example = order[new]  # the sort is stable: the first corner of each position
    appearance = np.argsort(example)
    rank = np.empty(len(example), np.int64)
    rank[appearance] = np.arange(len(example))
    corners = np.empty(len(soup), np.int64)
    corners[order] = rank[np.cumsum(new) - 1]
    return soup[example[appearance]], corners
