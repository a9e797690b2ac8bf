"""The sides of polygons, paired along their edges: what half-edges are for triangles.

Side i runs from corner i of a polygon to the corner that follows it. Topology read from sides knows nothing of how
polygons are cut into triangles, so no diagonal is ever taken for an edge.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .halfedges import paired_sides
from .polygons import PolygonMesh

__all__ = ["PolygonSides", "edge_keys", "following_corners", "polygon_sides"]

Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class PolygonSides:
    """Sides and the edges that they lie on.

    Attributes
    ----------
    follow : (k,) int64
        The corner after each corner in its polygon; side i runs from corner i to ``follow[i]``.
    polygon : (k,) int64
        The polygon of each corner.
    key : (e,) int64
        ``edge_keys`` of the edges, increasing.
    edge : (k,) int64
        The edge of each side.
    twin : (k,) int64
        The other side of the same edge; -1 where the edge has one side, -2 where three or more.
    """

    follow: Ints
    polygon: Ints
    key: Ints
    edge: Ints
    twin: Ints


def polygon_sides(mesh: PolygonMesh) -> PolygonSides:
    """Pair the sides of the polygons; at least one polygon, every polygon with at least one corner."""
    follow, n = following_corners(mesh), len(mesh.V)
    pairs = paired_sides(mesh.corners, mesh.corners[follow], n)
    polygon = np.repeat(np.arange(len(mesh.sizes)), mesh.sizes)
    edge, twin = pairs.edge.astype(np.int64), pairs.twin.astype(np.int64)
    return PolygonSides(follow, polygon, edge_keys(pairs.lo, pairs.hi, n), edge, twin)


def following_corners(mesh: PolygonMesh) -> Ints:
    """The corner after each corner in its polygon, (k,)."""
    follow = np.arange(1, len(mesh.corners) + 1)
    follow[mesh.starts[1:] - 1] = mesh.starts[:-1]
    return follow


def edge_keys(a: NDArray[np.integer], b: NDArray[np.integer], n: int) -> Ints:
    """A number for each unordered pair of vertices below n: ``min * n + max``."""
    key = np.minimum(a, b).astype(np.int64)
    key *= n
    key += np.maximum(a, b)
    return key
