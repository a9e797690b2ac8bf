"""Boundary loops, traced all at once by pointer doubling."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["boundary_loops"]


def boundary_loops(corners: NDArray[np.int32], twin: NDArray[np.int32]) -> list[NDArray[np.int64]]:
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
    m = corners.shape[1]
    h = np.flatnonzero(twin == -1)
    if not len(h):
        return []
    h = h[np.argsort(h % m * 3 + h // m)]  # reading order
    tail = corners[h // m, h % m].astype(np.int64)
    head = corners[(h // m + 1) % 3, h % m].astype(np.int64)
    place = np.argsort(tail)
    previous = np.empty(len(h), dtype=np.int64)
    previous[place[np.searchsorted(tail, head, sorter=place)]] = np.arange(len(h))

    root, jump = np.arange(len(h)), previous.copy()
    rounds = int(len(h) - 1).bit_length()
    for _ in range(rounds):  # the smallest half-edge of each loop
        root = np.minimum(root, root[jump])
        jump = jump[jump]
    is_root = root == np.arange(len(h))
    jump = np.where(is_root, np.arange(len(h)), previous)
    distance = (~is_root).astype(np.int64)
    for _ in range(rounds):  # steps from it
        distance += distance[jump]
        jump = jump[jump]
    order = np.lexsort((distance, root))
    return np.split(tail[order], np.flatnonzero(distance[order] == 0)[1:])
