"""Half-edges and edges of a triangle mesh, from one sort.

Half-edge ``c * m + f`` runs from corner c of face f to corner c + 1 (mod 3); opposite to it lies corner c + 2.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["HalfEdges", "half_edges", "sorted_keys"]


@dataclass(frozen=True, eq=False)
class HalfEdges:
    """Edges in order of (lower vertex, higher vertex), and the half-edges on each.

    Attributes
    ----------
    lo, hi : (e,) int32
        The two vertices of each edge, lo < hi; sorted, so an edge list is a lower triangular CSC pattern.
    edge : (3 m,) int32
        The edge of each half-edge.
    count : (e,) int8
        Number of half-edges on each edge, at most 127 (2 inside a manifold, 1 on its boundary).
    twin : (3 m,) int32
        The other half-edge of the same edge; -1 where the edge has one half-edge, -2 where three or more.
    """

    lo: NDArray[np.int32]
    hi: NDArray[np.int32]
    edge: NDArray[np.int32]
    count: NDArray[np.int8]
    twin: NDArray[np.int32]


def half_edges(corners: NDArray[np.int32], n: int) -> HalfEdges:
    """Pair the half-edges of the faces ``corners`` (3, m) over n vertices."""
    tail = corners.reshape(-1)
    head = corners[[1, 2, 0]].reshape(-1)
    n = int(n)
    key = np.minimum(tail, head).astype(np.int64)
    key *= n
    key += np.maximum(tail, head)
    key, order = sorted_keys(key, n)

    first = np.empty(len(key), dtype=bool)  # first half-edge of its edge, in sorted order
    first[0] = True
    np.not_equal(key[1:], key[:-1], out=first[1:])
    start = np.flatnonzero(first)
    count = np.diff(start, append=len(key))
    lo, hi = np.divmod(key[start], n)
    edge = np.empty(len(key), dtype=np.int32)
    edge[order] = np.cumsum(first, dtype=np.int32) - np.int32(1)

    twin = np.full(len(key), -1, dtype=np.int32)
    pair = start[count == 2]
    twin[order[pair]] = order[pair + 1]
    twin[order[pair + 1]] = order[pair]
    if count.max() > 2:
        twin[(count > 2)[edge]] = -2
    return HalfEdges(
        lo.astype(np.int32), hi.astype(np.int32), edge, np.minimum(count, 127).astype(np.int8), twin
    )


def sorted_keys(key: NDArray[np.int64], n: int) -> tuple[NDArray[np.int64], NDArray[np.integer]]:
    """Keys below n * n in order, and the permutation; packed into one integer where both fit into 63 bits."""
    bits = len(key).bit_length()
    if (n * n).bit_length() + bits > 63:
        order = np.argsort(key)
        return key[order], order
    key <<= bits
    key |= np.arange(len(key))
    key.sort()
    order = (key & ((1 << bits) - 1)).astype(np.int32)
    key >>= bits
    return key, order
