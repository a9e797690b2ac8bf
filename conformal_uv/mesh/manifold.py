"""Checks that a triangle mesh is an oriented 2-manifold, cheap where it is and specific where it is not."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import breadth_first_order, connected_components

from . import refusals
from .fans import corner_links, pinched_vertices
from .geometry import TriangleGeometry
from .halfedges import HalfEdges, joined_pairs
from .orientation import disagreeing_pairs, face_signs

__all__ = [
    "check_areas",
    "check_edges",
    "check_fans",
    "check_orientation",
    "face_components",
    "is_face_connected",
]


def check_edges(corners: NDArray[np.int32], edges: HalfEdges) -> None:
    """Raise DuplicateFaceError or NonManifoldError where an edge has three faces or a face stands twice."""
    m = corners.shape[1]
    crowded = np.flatnonzero(edges.count > 2)
    across = np.where(edges.twin >= 0, edges.twin % m, -1 - np.arange(3 * m, dtype=np.int32)).reshape(3, m)
    folded = (across[0] == across[1]) | (across[1] == across[2]) | (across[2] == across[0])
    if len(crowded) or folded.any():
        _, index, count = np.unique(np.sort(corners, axis=0), axis=1, return_inverse=True, return_counts=True)
        twice = np.flatnonzero(count[index.reshape(-1)] > 1)
        if len(twice):
            raise refusals.duplicates(twice)
    if len(crowded):
        faces = np.flatnonzero((edges.twin == -2).reshape(3, m).any(axis=0))
        raise refusals.crowded_edges(edges.lo[crowded], edges.hi[crowded], faces)


def check_orientation(corners: NDArray[np.int32], edges: HalfEdges) -> None:
    """Raise OrientationError naming the faces wound against the rest, or saying that there is one side only."""
    vertex, m = corners.reshape(-1), corners.shape[1]
    if not len(disagreeing_pairs(vertex, edges.twin)):
        return
    sign = face_signs(vertex, np.arange(3 * m) % m, edges.twin, m)
    if (sign == 0).any():
        raise refusals.one_sided(np.flatnonzero(sign == 0))
    raise refusals.disagreeing(np.flatnonzero(sign < 0))


def check_fans(corners: NDArray[np.int32], edges: HalfEdges, n: int) -> None:
    """Raise NonManifoldError where the faces around a vertex form more than one fan."""
    half_edge = np.arange(len(edges.twin))
    following = (half_edge + corners.shape[1]) % len(half_edge)
    vertex = corners.reshape(-1).astype(np.int64)
    bad = pinched_vertices(vertex, *corner_links(vertex, following, *joined_pairs(edges.twin)), n)
    if len(bad):
        raise refusals.pinched(bad)


def is_face_connected(corners: NDArray[np.int32], edges: HalfEdges) -> bool:
    """Whether every face can be reached from face 0 across edges."""
    m = corners.shape[1]
    across = np.where(edges.twin >= 0, edges.twin % m, np.tile(np.arange(m, dtype=np.int32), 3))
    neighbour = np.ascontiguousarray(across.reshape(3, m).T).reshape(-1)
    graph = csr_array((np.ones(3 * m), neighbour, np.arange(0, 3 * m + 1, 3, dtype=np.int32)), shape=(m, m))
    return len(breadth_first_order(graph, 0, directed=True, return_predecessors=False)) == m


def face_components(corners: NDArray[np.int32], n: int) -> tuple[int, NDArray[np.int32]]:
    """Number of connected pieces, and the piece of each face, (m,); faces sharing a vertex are connected."""
    rows, columns = corners[:2].reshape(-1), corners[1:].reshape(-1)
    graph = coo_array((np.ones(len(rows), dtype=np.int8), (rows, columns)), shape=(n, n))
    label = connected_components(graph, directed=False)[1][corners[0]]
    _, piece = np.unique(label, return_inverse=True)
    return int(piece.max()) + 1, piece.astype(np.int32)


def check_areas(geometry: TriangleGeometry) -> None:
    """Raise DegenerateFaceError where a face has no area."""
    bad = geometry.degenerate
    if len(bad):
        raise refusals.areas_lost(bad)
