"""Connected components of a graph that no rank holds as a whole: hooking and pointer jumping.

Y. Shiloach, U. Vishkin, "An O(log n) parallel connectivity algorithm", 1982, with labels that only ever fall.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from .ranks import Ranks
from .shares import Shares, fetched, lowered

__all__ = ["joined_components", "local_representatives"]

Ints = NDArray[np.int64]


def joined_components(ranks: Ranks, shares: Shares, u: Ints, v: Ints) -> Ints:
    """The lowest node of the component of each of this rank's nodes; edges u, v stand on any rank."""
    label = np.arange(shares.first, shares.last, dtype=np.int64)
    while True:
        at_u, at_v = fetched(ranks, shares, label, u), fetched(ranks, shares, label, v)
        low, high = np.minimum(at_u, at_v), np.maximum(at_u, at_v)
        apart = low < high
        if not ranks.any(bool(apart.any())):
            return label
        lowered(ranks, shares, label, high[apart], low[apart])
        label = fetched(ranks, shares, label, label)


def local_representatives(count: int, one: NDArray[np.integer], other: NDArray[np.integer], names: Ints) -> Ints:
    """The lowest name in the component of each of `count` nodes of this rank, edges one, other."""
    graph = coo_array((np.ones(len(one), dtype=np.int8), (one, other)), shape=(count, count))
    pieces, label = connected_components(graph, directed=False)
    lowest = np.full(pieces, np.iinfo(np.int64).max)
    np.minimum.at(lowest, label, names)
    return lowest[label]
