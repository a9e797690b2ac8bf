"""A file's mesh as triangles over the vertices that they use."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.polygons import PolygonMesh
from ..mesh.triangulate import triangulate

__all__ = ["compact_triangles"]


def compact_triangles(mesh: PolygonMesh) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Vertices in use and triangles over them."""
    F, _, _ = triangulate(mesh)
    used, F = np.unique(F, return_inverse=True)
    return mesh.V[used], F.reshape(-1, 3)
