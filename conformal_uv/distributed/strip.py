"""The strip of the mesh along its boundary, gathered for the preconditioner of Newton's method."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..operators.edge_laplacian import EdgeLaplacian
from ..operators.neumann_strip import NeumannStrip
from .part import Part
from .ranks import Ranks

__all__ = ["SharedStrip", "gathered_strip"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]


class SharedStrip:
    """The first rank's `NeumannStrip`, its answers handed to all: so all take the same steps."""

    def __init__(self, ranks: Ranks, strip: NeumannStrip | None) -> None:
        self._ranks, self._strip = ranks, strip

    def __call__(self, inflow: Real) -> Real:
        """See NeumannStrip; collective."""
        out = np.empty_like(inflow) if self._strip is None else np.ascontiguousarray(self._strip(inflow))
        return self._ranks.same(out)


def gathered_strip(part: Part, place: Ints, weights: Real, boundary: Ints, rings: int) -> SharedStrip:
    """From edges with an end in the first rings; the boundary's length times a dozen, on one rank."""
    ranks = part.ranks
    lo, hi = part.edges.lo, part.edges.hi
    kept = place >= 0
    for _ in range(rings):
        grown = kept.copy()
        crossing = kept[lo] ^ kept[hi]
        grown[lo[crossing]] = grown[hi[crossing]] = True
        kept = part.with_ghosts(grown[: part.own])
    told, low, high = part.told_edges()
    taken = told & (kept[lo] | kept[hi])
    pairs = ranks.joined(np.column_stack((low[taken], high[taken])))
    values = ranks.joined(weights[taken])
    strip = None
    with ranks.agreed():
        if ranks.rank == 0:
            names, number = np.unique(pairs, return_inverse=True)
            number = number.reshape(-1, 2)
            order = np.lexsort((number[:, 1], number[:, 0]))
            a, b = number[order].T.astype(np.int32)
            edges = EdgeLaplacian(a, b, values[order], "cotan")
            strip = NeumannStrip(edges, np.searchsorted(names, boundary), len(names))
    return SharedStrip(ranks, strip)
