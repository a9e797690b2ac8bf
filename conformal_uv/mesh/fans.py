"""The fans of polygons around vertices: which corners of a vertex hang together across joined sides."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

__all__ = ["corner_links", "pinched_vertices", "split_corners"]

Ints = NDArray[np.int64]


def corner_links(vertex: Ints, follow: Ints, one: Ints, other: Ints) -> tuple[Ints, Ints]:
    """Corners that lie side by side at a vertex because sides `one` and `other` are joined.

    Two links for each pair of sides, one at either end; sides that run the same way are joined tail to tail.
    """
    one_next, other_next = follow[one], follow[other]
    same = vertex[one] == vertex[other]
    left = np.concatenate((one, one_next))
    right = np.concatenate((np.where(same, other, other_next), np.where(same, other_next, other)))
    return left, right


def pinched_vertices(vertex: Ints, left: Ints, right: Ints, n: int) -> Ints:
    """Vertices whose corners, linked left to right, form more than one fan."""
    _, first = _fans(len(vertex), left, right)
    return np.flatnonzero(np.bincount(vertex[first], minlength=n) > 1)


def split_corners(vertex: Ints, left: Ints, right: Ints, n: int, touched: NDArray[np.bool_]) -> tuple[Ints, Ints]:
    """A site for every fan at every vertex: the vertices of the surface after it was cut.

    Parameters
    ----------
    vertex : (k,)
        Vertex of each corner.
    left, right : (l,)
        Linked corners, as from `corner_links`.
    n : int
        Number of vertices.
    touched : (n,) bool
        Vertices that may have several fans; the others are left whole.

    Returns
    -------
    site : (k,) int64
        The vertex itself for its first fan, n, n + 1, ... for the others, in the order of their first corners.
    vertex_of_site : (s,) int64
    """
    corner = np.flatnonzero(touched[vertex])
    number = np.full(len(vertex), -1, dtype=np.int64)
    number[corner] = np.arange(len(corner))
    kept = touched[vertex[left]]
    label, first = _fans(len(corner), number[left[kept]], number[right[kept]])
    first = corner[first]
    at = vertex[first]
    order = np.lexsort((first, at))
    later = order[1:][at[order[1:]] == at[order[:-1]]]
    later = later[np.argsort(first[later])]
    name = at.copy()
    name[later] = n + np.arange(len(later))
    site = vertex.copy()
    site[corner] = name[label]
    return site, np.concatenate((np.arange(n), at[later]))


def _fans(k: int, left: Ints, right: Ints) -> tuple[Ints, Ints]:
    """The fan of each of k corners, and the first corner of each fan."""
    graph = coo_array((np.ones(len(left), dtype=np.int8), (left, right)), shape=(k, k))
    count, label = connected_components(graph, directed=False)
    first = np.empty(count, dtype=np.int64)
    first[label[::-1]] = np.arange(k - 1, -1, -1)  # the last of several assignments stays
    return label, first
