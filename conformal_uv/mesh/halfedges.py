"""Sides of faces paired along their edges, from one sort; the sides of triangles are called half-edges.

Half-edge ``c * m + f`` runs from corner c of face f to corner c + 1 (mod 3); opposite to it lies corner c + 2.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from ..concise import Concise

__all__ = ["HalfEdges", "half_edges", "joined_pairs", "paired_sides", "sorted_pairs"]


@dataclass(frozen=True, eq=False, repr=False)
class HalfEdges(Concise):
    """Edges in order of (lower vertex, higher vertex), and the half-edges (or sides of polygons, k of them) on each.

    Attributes
    ----------
    lo, hi : (e,) int32
        The two vertices of each edge, lo < hi; sorted, so an edge list is a lower triangular CSC pattern.
    edge : (k,) int32
        The edge of each half-edge.
    count : (e,) int8
        Number of half-edges on each edge, at most 127 (2 inside a manifold, 1 on its boundary).
    twin : (k,) int32
        The other half-edge of the same edge; -1 where the edge has one half-edge, -2 where three or more.
    """

    lo: NDArray[np.int32]
    hi: NDArray[np.int32]
    edge: NDArray[np.int32]
    count: NDArray[np.int8]
    twin: NDArray[np.int32]


def half_edges(corners: NDArray[np.int32], n: int) -> HalfEdges:
    """Pair the half-edges of the triangles ``corners`` (3, m) over n vertices."""
    return paired_sides(corners.reshape(-1), corners[[1, 2, 0]].reshape(-1), n)


def paired_sides(tail: NDArray[np.integer], head: NDArray[np.integer], n: int) -> HalfEdges:
    """Pair sides that run between the same two vertices; `head` (k,), a fresh array, is used up."""
    lo, hi = np.minimum(tail, head), np.maximum(tail, head, out=head)
    order = sorted_pairs(lo, hi, int(n))
    lo, hi = lo.take(order), hi.take(order)

    first = np.empty(len(order), dtype=bool)  # first half-edge of its edge, in sorted order
    first[0] = True
    np.not_equal(lo[1:], lo[:-1], out=first[1:])
    first[1:] |= hi[1:] != hi[:-1]
    edge = np.empty(len(order), dtype=np.int32)
    edge[order] = np.cumsum(first, dtype=np.int32) - np.int32(1)
    start = np.flatnonzero(first).astype(np.int32)
    count = np.diff(start, append=np.int32(len(order)))

    twin = np.full(len(order), -1, dtype=np.int32)
    pair = start[count == 2]
    one, other = order.take(pair), order.take(pair + 1)
    twin[one], twin[other] = other, one
    if count.max() > 2:
        twin[(count > 2)[edge]] = -2
    return HalfEdges(lo.take(start), hi.take(start), edge, np.minimum(count, 127).astype(np.int8), twin)


def joined_pairs(twin: NDArray[np.integer]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Sides and the ones across them, each pair once."""
    one = np.flatnonzero(twin > np.arange(len(twin), dtype=twin.dtype))
    return one, twin.take(one).astype(np.int64, copy=False)


def sorted_pairs(lo: NDArray[np.integer], hi: NDArray[np.integer], n: int) -> NDArray[np.int32]:
    """The stable order of pairs of numbers below n by (lo, hi).

    A sort by buckets, first by hi and then by lo: turning a sparse matrix with one entry a row from rows into columns
    is just that.
    """
    row = np.arange(len(lo) + 1, dtype=np.int32)
    by_hi = csr_array((lo, hi, row), shape=(len(lo), n)).tocsc()
    return csr_array((by_hi.indices, by_hi.data, row), shape=(len(lo), n)).tocsc().data
