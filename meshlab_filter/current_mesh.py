"""The current mesh of a MeshSet as conformal_uv takes it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from conformal_uv import PolygonMesh

from .wedges import Wedges, triangle_wedges, wedges_of_polygons

__all__ = ["CurrentMesh", "read_current_mesh"]


@dataclass(frozen=True, eq=False)
class CurrentMesh:
    """Copies of what the map needs.

    Attributes
    ----------
    mesh : pymeshlab.Mesh
        The current mesh itself.
    F : (m, 3) int64
        Its triangles.
    polygons : PolygonMesh
        Its polygons, or the triangles again where it has none.
    wedges : Wedges
        Where the triangles' corners are among the polygons'.
    """

    mesh: Any
    F: NDArray[np.int64]
    polygons: PolygonMesh
    wedges: Wedges

    def selected_polygons(self) -> NDArray[np.bool_]:
        """Polygons all of whose triangles are selected, (p,)."""
        selected = np.ones(len(self.polygons.sizes), dtype=bool)
        selected[self.wedges.polygon[~self.mesh.face_selection_array()]] = False
        return selected


def read_current_mesh(ms: Any) -> CurrentMesh:
    """Copy positions and polygons out of the current mesh of `ms`.

    Raises
    ------
    pymeshlab.PyMeshLabException
        The MeshSet has no current mesh.
    pymeshlab.MissingCompactnessException
        The mesh has deleted elements.
    """
    mesh = ms.current_mesh()
    V = np.ascontiguousarray(mesh.vertex_matrix(), dtype=np.float64)
    F = np.ascontiguousarray(mesh.face_matrix(), dtype=np.int64).reshape(-1, 3)
    listed = mesh.polygonal_face_list()
    wedges = wedges_of_polygons(F, listed, len(V)) if len(listed) < len(F) else None
    if wedges is None:
        wedges = triangle_wedges(F)
    return CurrentMesh(mesh, F, PolygonMesh(V, wedges.corners, wedges.starts), wedges)
