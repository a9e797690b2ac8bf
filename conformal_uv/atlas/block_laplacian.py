"""The Laplacian of many disks at once: a block of one matrix for each."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..mesh.geometry import TriangleGeometry
from ..mesh.halfedges import HalfEdges
from ..operators.edge_laplacian import ROUNDING, EdgeLaplacian, cotan_edges, intrinsic_delaunay_edges
from ..options import Laplacian

__all__ = ["Blocks", "block_laplacian"]

Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]


class Blocks(NamedTuple):
    """The Laplacian of all disks, and which of them (c,) have that of their intrinsic Delaunay triangulation."""

    laplacian: EdgeLaplacian
    intrinsic: Bools


def block_laplacian(
    corners: NDArray[np.int32],
    edges: HalfEdges,
    geometry: TriangleGeometry,
    of_vertex: Ints,
    count: int,
    kind: Laplacian,
) -> Blocks:
    """The Laplacian that `edge_laplacian` gives each disk by itself.

    An edge flip knows its two faces only, so all disks are made Delaunay together; on those whose weights were not
    negative nothing is flipped.
    """
    plain = cotan_edges(edges, geometry)
    intrinsic = np.full(count, kind is Laplacian.INTRINSIC_DELAUNAY)
    if kind is Laplacian.AUTO:
        negative = (plain.weights < -ROUNDING) & (edges.count == 2)
        intrinsic[of_vertex[edges.lo[negative]]] = True
    if not intrinsic.any():
        return Blocks(plain, intrinsic)
    return Blocks(intrinsic_delaunay_edges(corners, edges, geometry, len(of_vertex), plain), intrinsic)
