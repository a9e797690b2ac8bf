"""Whether the faces of a mesh can be wound one way, and which stand against the others."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from .halfedges import joined_pairs

__all__ = ["disagreeing_pairs", "face_signs"]

Ints = NDArray[np.integer]


def disagreeing_pairs(vertex: Ints, twin: Ints) -> Ints:
    """Sides that run in the same direction as their twin, each pair once, (k,).

    Parameters
    ----------
    vertex : (k,)
        Where each side begins.
    twin : (k,)
        The side across, negative where there is none or more than one.
    """
    one, other = joined_pairs(twin)
    return one[vertex.take(one) == vertex.take(other)]


def face_signs(vertex: Ints, face: Ints, twin: Ints, count: int) -> NDArray[np.int8]:
    """+1 or -1 for each of `count` faces so that faces with the sign applied agree; 0 on one-sided pieces.

    In every connected piece the larger part has +1. The components of the double cover, whose nodes are the
    faces wound either way, tell: a piece is one-sided when both windings of a face lie in one component.

    Parameters
    ----------
    vertex, twin
        As in `disagreeing_pairs`.
    face : (k,)
        The face of each side.
    """
    one, other = joined_pairs(twin)
    f, g = face[one], face[other]
    crossed = (vertex[one] == vertex[other]).astype(np.int64)
    rows = np.concatenate((f, f + count))
    columns = np.concatenate((g + count * crossed, g + count * (1 - crossed)))
    cover = coo_array((np.ones(len(rows), dtype=np.int8), (rows, columns)), shape=(2 * count, 2 * count))
    pieces, label = connected_components(cover, directed=False)
    plus, minus = label[:count], label[count:]
    piece = np.minimum(plus, minus)
    lead = plus == piece
    larger = 2 * np.bincount(piece, weights=lead, minlength=pieces) >= np.bincount(piece, minlength=pieces)
    sign = np.where(lead == larger[piece], 1, -1).astype(np.int8)
    sign[plus == minus] = 0
    return sign
