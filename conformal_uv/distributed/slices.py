"""A rank's rows of V and F, checked together with those of the other ranks."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..mesh import refusals
from ..mesh.arrays import MOST_VERTICES, face_indices, vertex_numbers
from .ranks import Ranks
from .shares import Shares

__all__ = ["MeshSlice", "checked_slice"]


class MeshSlice(NamedTuple):
    """Consecutive rows of a mesh, the ranks' one after the other's.

    Attributes
    ----------
    V : (k, 3) float64
        Vertices `vertices.first` .. `vertices.last` - 1.
    F : (l, 3) int32 or int64
        Faces `faces.first` .. `faces.last` - 1, of vertices of any rank.
    vertices, faces : Shares
    """

    V: NDArray[np.float64]
    F: NDArray[Any]
    vertices: Shares
    faces: Shares


def checked_slice(ranks: Ranks, V: ArrayLike, F: ArrayLike) -> MeshSlice:
    """Raise what `vertex_array` and `face_array` would of the whole mesh, with the same indices, on all ranks."""
    rows = _rows_of_all(ranks, V)
    with ranks.agreed():
        own_V = vertex_numbers(V, rows)
    vertices = Shares.of_counts(ranks, len(own_V))
    bad = ranks.indices(vertices.first + np.flatnonzero(~np.isfinite(own_V).all(axis=1)))
    if len(bad):
        raise refusals.non_finite(bad, vertices.count)
    rows = _rows_of_all(ranks, F)
    with ranks.agreed():
        own_F = face_indices(F, rows)
    faces = Shares.of_counts(ranks, len(own_F))
    n = vertices.count
    if not faces.count or not n:
        raise refusals.empty(n, faces.count)
    lowest = -int(ranks.most(-float(own_F.min(initial=n))))
    highest = int(ranks.most(float(own_F.max(initial=0))))
    if lowest < 0 or highest >= n:
        outside = ((own_F < 0) | (own_F >= n)).any(axis=1)
        raise refusals.outside(ranks.indices(faces.first + np.flatnonzero(outside)), n, lowest, highest)
    small = max(n, faces.count) <= MOST_VERTICES
    own_F = np.ascontiguousarray(own_F, dtype=np.int32 if small else np.int64)
    a, b, c = own_F.T
    bad = ranks.indices(faces.first + np.flatnonzero((a == b) | (b == c) | (c == a)))
    if len(bad):
        raise refusals.repeated(bad)
    return MeshSlice(own_V, own_F, vertices, faces)


def _rows_of_all(ranks: Ranks, array: ArrayLike) -> int | None:
    """How many rows the ranks have together; None where one of them has no array."""
    shapes = ranks.each(np.shape(array) if isinstance(array, np.ndarray) else ())
    return sum(shape[0] for shape in shapes) if all(shapes) else None
