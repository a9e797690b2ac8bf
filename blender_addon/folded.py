"""Faces whose UVs are inverted or collapsed, found in the UVs as Blender stores them."""

from __future__ import annotations

import bpy
import numpy as np
from numpy.typing import NDArray

from conformal_uv import PolygonMesh, flipped_polygons

from .edit_mode import object_mode, target_objects
from .mesh_io import read_mesh, read_uv, write_selection


def select_folded(context: bpy.types.Context) -> int:
    """Select such faces in all edited meshes and nothing else; how many there are."""
    count = 0
    objects = target_objects(context)
    with object_mode(context):
        for ob in objects:
            folded = folded_faces(ob.data)
            write_selection(ob.data, folded)
            count += int(folded.sum())
    return count


def folded_faces(mesh: bpy.types.Mesh) -> NDArray[np.bool_]:
    """Visible faces with a triangle of no positive area in the active UV map, (p,); none without a UV map."""
    layer = mesh.uv_layers.active
    if layer is None or not len(mesh.polygons):
        return np.zeros(len(mesh.polygons), dtype=bool)
    arrays = read_mesh(mesh, layer.name)
    polygons = PolygonMesh(arrays.V.astype(np.float64), arrays.corners.astype(np.int64), arrays.starts.astype(np.int64))
    folded = np.zeros(len(mesh.polygons), dtype=bool)
    folded[flipped_polygons(polygons, read_uv(mesh, layer.name))] = True
    return folded & ~arrays.hidden
