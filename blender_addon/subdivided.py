"""The surface that an object's Subdivision Surface modifiers make, and the way back to its own corners."""

from __future__ import annotations

from dataclasses import dataclass, replace

import bpy
import numpy as np
from numpy.typing import NDArray

from .mesh_reading import MeshArrays, read_mesh

ORIGIN = "conformal_uv_face"


@dataclass(frozen=True, eq=False)
class Subdivision:
    """A subdivided mesh.

    Attributes
    ----------
    arrays : MeshArrays
        The subdivided mesh.
    face : (p,) int32
        The face of the object's mesh that each of its faces lies in.
    corner : (k,) integers
        For each corner of the object's mesh, the corner of the subdivided mesh at the same place in the same face.
    starts : (q + 1,) int32
        First corner of each face of the object's mesh, and k.
    """

    arrays: MeshArrays
    face: NDArray[np.int32]
    corner: NDArray[np.int64]
    starts: NDArray[np.int32]

    def whole_faces(self, mapped: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Faces of the object's mesh, (q,), all of whose parts are in a mask (p,)."""
        parts = np.bincount(self.face, minlength=len(self.starts) - 1)
        return (parts > 0) & (np.bincount(self.face[mapped], minlength=len(parts)) == parts)

    def faces_of(self, faces: NDArray[np.int64]) -> NDArray[np.int64]:
        """The object's faces for some of the subdivided ones, each once."""
        return np.unique(self.face[faces])


def read_subdivided(context: bpy.types.Context, ob: bpy.types.Object, arrays: MeshArrays) -> Subdivision | None:
    """Evaluate the object with its Subdivision Surface modifiers alone; None where it has none that is shown.

    Parameters
    ----------
    arrays : MeshArrays
        Of the object's own mesh.
    """
    if not any(modifier.type == "SUBSURF" and modifier.show_viewport for modifier in ob.modifiers):
        return None
    if ob.mode == "EDIT":
        ob.update_from_editmode()
    copy = ob.copy()
    copy.data = mesh = ob.data.copy()
    try:
        for modifier in [modifier for modifier in copy.modifiers if modifier.type != "SUBSURF"]:
            copy.modifiers.remove(modifier)
        origin = mesh.attributes.new(ORIGIN, "INT", "FACE")
        origin.data.foreach_set("value", np.arange(len(mesh.polygons), dtype=np.int32))
        context.scene.collection.objects.link(copy)
        evaluated = copy.evaluated_get(context.evaluated_depsgraph_get())
        return _subdivision(evaluated.data, arrays)
    finally:
        bpy.data.objects.remove(copy)
        bpy.data.meshes.remove(mesh)


def _subdivision(mesh: bpy.types.Mesh, coarse: MeshArrays) -> Subdivision:
    fine = replace(
        read_mesh(mesh, ""), pins=coarse.pins, alone=coarse.alone
    )  # `pinned` is asked of the object's own faces
    face = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.attributes[ORIGIN].data.foreach_get("value", face)
    n = len(coarse.V)  # the vertices of the control mesh come first
    own = np.flatnonzero(fine.corners < n)
    owner = np.repeat(face, np.diff(fine.starts))[own].astype(np.int64)
    key = owner * n + fine.corners[own]
    order = np.argsort(key)
    polygon = np.repeat(np.arange(len(coarse.starts) - 1, dtype=np.int64), np.diff(coarse.starts))
    wanted = polygon * n + coarse.corners
    return Subdivision(fine, face, own[order[np.searchsorted(key, wanted, sorter=order)]], coarse.starts)
