"""Whether the faces of a mesh can be wound one way, and which stand against the others."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

__all__ = ["disagreeing_pairs", "face_signs"]


def disagreeing_pairs(corners: NDArray[np.int32], twin: NDArray[np.int32]) -> NDArray[np.int64]:
    """Half-edges that run in the same direction as their twin, each pair once, (k,)."""
    tail = corners.reshape(-1)
    h = np.flatnonzero(twin > np.arange(len(twin), dtype=np.int32))
    return h[tail.take(h) == tail.take(twin.take(h))]


def face_signs(corners: NDArray[np.int32], twin: NDArray[np.int32]) -> NDArray[np.int8]:
    """+1 or -1 for each face so that faces with the sign applied agree, (m,); 0 on one-sided pieces.

    In every connected piece the larger side has +1. The components of the double cover, whose nodes are the
    faces wound either way, tell: a piece is one-sided when both windings of a face lie in one component.
    """
    m = corners.shape[1]
    tail = corners.reshape(-1)
    h = np.flatnonzero(twin >= 0)
    h = h[h < twin[h]]
    f, g = h % m, twin[h] % m
    crossed = (tail[h] == tail[twin[h]]).astype(np.int64)
    rows = np.concatenate((f, f + m))
    columns = np.concatenate((g + m * crossed, g + m * (1 - crossed)))
    cover = coo_array((np.ones(len(rows), dtype=np.int8), (rows, columns)), shape=(2 * m, 2 * m))
    count, label = connected_components(cover, directed=False)
    plus, minus = label[:m], label[m:]
    piece = np.minimum(plus, minus)
    lead = (plus == piece).astype(np.int64)
    larger = 2 * np.bincount(piece, weights=lead, minlength=count) >= np.bincount(piece, minlength=count)
    sign = np.where((lead == 1) == larger[piece], 1, -1).astype(np.int8)
    sign[plus == minus] = 0
    return sign
