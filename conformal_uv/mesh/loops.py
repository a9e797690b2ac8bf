"""Boundary loops, traced all at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .loop_order import loop_order

__all__ = ["boundary_loops", "joined_loops", "traced_loops"]

Ints = NDArray[np.int64]


def boundary_loops(corners: NDArray[np.int32], twin: NDArray[np.int32]) -> list[Ints]:
    """Vertices of every boundary loop, in the direction of the faces' winding.

    Each loop starts at its first boundary half-edge when faces are read in order, edges (0, 1), (1, 2), (2, 0);
    loops come in the order of those half-edges.

    Parameters
    ----------
    corners : (3, m) int32
        Faces; at most one boundary half-edge may leave each vertex.
    twin : (3 m,) int32
        As in HalfEdges.
    """
    vertices, starts = joined_loops(corners, twin)
    return np.split(vertices, starts[1:]) if len(starts) else []


def joined_loops(corners: NDArray[np.int32], twin: NDArray[np.int32]) -> tuple[Ints, Ints]:
    """The same, one loop after the other (k,), and where each of them begins."""
    m = corners.shape[1]
    h = np.flatnonzero(twin == -1)
    if not len(h):
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    h = h[np.argsort(h % m * 3 + h // m)]  # reading order
    return traced_loops(corners[h // m, h % m].astype(np.int64), corners[(h // m + 1) % 3, h % m].astype(np.int64))


def traced_loops(tail: Ints, head: Ints) -> tuple[Ints, Ints]:
    """The same from the boundary half-edges in reading order, each from `tail` to `head`."""
    place = np.argsort(tail)
    previous = np.empty(len(tail), dtype=np.int64)
    previous[place[np.searchsorted(tail, head, sorter=place)]] = np.arange(len(tail))

    loop, steps = loop_order(previous)
    order = np.lexsort((steps, loop))
    return tail[order], np.flatnonzero(steps[order] == 0)
