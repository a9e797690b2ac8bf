"""One of many disks by itself."""

from __future__ import annotations

import numpy as np

from ..mesh.geometry import TriangleGeometry
from ..mesh.halfedges import HalfEdges
from ..mesh.surface import Surface
from .disks import Disks

__all__ = ["surface_of"]


def surface_of(disks: Disks, disk: int) -> Surface:
    """One of the disks by itself."""
    v, f = disks.first_vertex[disk : disk + 2], disks.first_face[disk : disk + 2]
    m, first = disks.corners.shape[1], int(v[0])
    corners = disks.corners[:, f[0] : f[1]] - np.int32(first)
    e = slice(*np.searchsorted(disks.edges.lo, v).tolist())
    edge = disks.edges.edge.reshape(3, m)[:, f[0] : f[1]].reshape(-1) - np.int32(e.start)
    twin = disks.edges.twin.reshape(3, m)[:, f[0] : f[1]].reshape(-1)
    own = twin // m * (f[1] - f[0]) + twin % m - f[0]
    edges = HalfEdges(
        disks.edges.lo[e] - np.int32(first),
        disks.edges.hi[e] - np.int32(first),
        edge,
        disks.edges.count[e].copy(),
        np.where(twin < 0, twin, own).astype(np.int32),
    )
    part = slice(*f.tolist())
    geometry = TriangleGeometry(disks.geometry.dot[:, part].copy(), disks.geometry.double_area[part].copy())
    loop = disks.loop[disks.first_boundary[disk] : disks.first_boundary[disk + 1]] - first
    return Surface(disks.V[slice(*v.tolist())].copy(), corners, edges, geometry, [loop], 1, float(disks.unit[disk]))
