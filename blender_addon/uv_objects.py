"""Objects whose UVs the live tools change, with their stored UVs as conformal_uv takes them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import bpy
import numpy as np
from numpy.typing import NDArray

from conformal_uv import PolygonMesh, flipped_polygons

from .edit_mode import settled_mesh
from .mesh_reading import read_corner_flags, read_mesh, read_selected_vertices, read_uv, selected_uvs
from .words import counted


@dataclass(frozen=True, eq=False)
class UVObject:
    """An object with an active UV map.

    Attributes
    ----------
    mesh : PolygonMesh
    uv : (k, 2) float32
        Of the active UV map.
    visible, selected : (p,) bool
        Faces; where none is selected in Object Mode all visible ones count as selected.
    pinned, picked : (k,) bool
        Corners with a pinned UV, and those that are selected as the UV editor shows it.
    """

    ob: bpy.types.Object
    mesh: PolygonMesh
    uv: NDArray[np.float32]
    visible: NDArray[np.bool_]
    selected: NDArray[np.bool_]
    pinned: NDArray[np.bool_]
    picked: NDArray[np.bool_]

    @property
    def corner_face(self) -> NDArray[np.int64]:
        """The face of every corner, (k,)."""
        return np.repeat(np.arange(len(self.mesh.starts) - 1), self.mesh.sizes)

    def newly_folded(self, values: NDArray[np.float32], faces: NDArray[np.int64]) -> int:
        """How many of some faces are flipped or collapsed with UVs (k, 2) of the corners, and were not."""
        after = np.intersect1d(flipped_polygons(self.mesh, values), faces)
        return len(np.setdiff1d(after, flipped_polygons(self.mesh, self.uv))) if len(after) else 0


def folds_told(done: str, folded: int) -> str:
    """A message, with the faces that folded if there are any."""
    if not folded:
        return done
    more = counted(
        folded,
        "{count} more face is flipped or collapsed now",
        "{count} more faces are flipped or collapsed now",
    )
    return f"{done}; {more}"


def uv_objects(context: bpy.types.Context, objects: Iterable[bpy.types.Object]) -> list[UVObject]:
    """Read those of the objects that have faces and a UV map, and may be written."""
    return [_read(context, ob) for ob in objects if not _refused(ob)]


def _refused(ob: bpy.types.Object) -> bool:
    """Whether there is nothing to change, or it can not be changed through this object."""
    mesh = ob.data
    elsewhere = mesh.is_editmode and ob.mode != "EDIT"
    return elsewhere or mesh.library is not None or mesh.uv_layers.active is None


def _read(context: bpy.types.Context, ob: bpy.types.Object) -> UVObject:
    layer = ob.data.uv_layers.active.name
    synchronous = context.scene.tool_settings.use_uv_select_sync
    with settled_mesh(ob) as mesh:
        arrays, uv = read_mesh(mesh, layer), read_uv(mesh, layer)
        pinned = read_corner_flags(mesh, f".pn.{layer}")
        picked = read_selected_vertices(mesh)[arrays.corners] if synchronous else selected_uvs(mesh)
    visible = ~arrays.hidden
    selected = visible & arrays.selected
    if ob.mode != "EDIT" and not selected.any():
        selected = visible
    polygons = PolygonMesh(arrays.V.astype(np.float64), arrays.corners.astype(np.int64), arrays.starts.astype(np.int64))
    return UVObject(ob, polygons, uv, visible, selected, pinned, picked)
