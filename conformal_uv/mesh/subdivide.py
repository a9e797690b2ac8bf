"""Splitting edges of a triangle mesh at their midpoints."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .halfedges import HalfEdges

__all__ = ["split_edges"]


def split_edges(
    V: NDArray[np.float64], corners: NDArray[np.int32], edges: HalfEdges, marked: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Insert the midpoints of the marked edges; old vertices keep their numbers, new ones follow.

    Returns
    -------
    V : (n + k, 3) float64
    corners : (3, m') int32
    """
    m, n = corners.shape[1], len(V)
    middle = np.full(len(edges.lo), -1, dtype=np.int32)
    middle[marked] = n + np.arange(len(marked), dtype=np.int32)
    on_side = middle[edges.edge].reshape(3, m)  # midpoint on half-edge c, -1 where there is none
    count = (on_side >= 0).sum(axis=0)
    # Turn each face so that its first marked side comes after an unmarked one; corners and sides turn together.
    turn = np.zeros(m, dtype=np.int64)
    for c in range(3):
        starts = (on_side[c] >= 0) & (on_side[(c + 2) % 3] < 0)
        turn[starts] = c
    at = (turn + np.arange(3)[:, None]) % 3
    (a, b, c), (ab, bc, ca) = np.take_along_axis(corners, at, 0), np.take_along_axis(on_side, at, 0)
    one, two, three = count == 1, count == 2, count == 3
    faces = [
        corners[:, count == 0],
        np.stack((a, ab, c))[:, one],
        np.stack((ab, b, c))[:, one],
        np.stack((a, ab, c))[:, two],
        np.stack((ab, bc, c))[:, two],
        np.stack((ab, b, bc))[:, two],
        np.stack((a, ab, ca))[:, three],
        np.stack((ab, b, bc))[:, three],
        np.stack((ca, bc, c))[:, three],
        np.stack((ab, bc, ca))[:, three],
    ]
    midpoints = 0.5 * (V[edges.lo[marked]] + V[edges.hi[marked]])
    return np.concatenate((V, midpoints)), np.ascontiguousarray(np.concatenate(faces, axis=1))
