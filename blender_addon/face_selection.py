"""Faces found by what their UVs are like, selected in all edited meshes."""

from __future__ import annotations

from collections.abc import Callable

import bpy
import numpy as np
from numpy.typing import NDArray

from conformal_uv import PolygonMesh

from .edit_mode import object_mode, target_objects
from .mesh_reading import MeshArrays, read_mesh, read_uv
from .mesh_writing import write_selection


def select_faces(context: bpy.types.Context, faces_of: Callable[[bpy.types.Mesh], NDArray[np.bool_]]) -> int:
    """Select the faces that the function finds in each mesh and nothing else; how many there are."""
    count = 0
    objects = target_objects(context)
    with object_mode(context):
        for ob in objects:
            faces = faces_of(ob.data)
            write_selection(ob.data, faces)
            count += int(faces.sum())
    return count


def mapped_mesh(mesh: bpy.types.Mesh) -> tuple[MeshArrays, PolygonMesh, NDArray[np.float32]] | None:
    """A mesh in Object Mode with its active UV map (k, 2); None where it has none, or no faces."""
    layer = mesh.uv_layers.active
    if layer is None or not len(mesh.polygons):
        return None
    arrays = read_mesh(mesh, layer.name)
    polygons = PolygonMesh(arrays.V.astype(np.float64), arrays.corners.astype(np.int64), arrays.starts.astype(np.int64))
    return arrays, polygons, read_uv(mesh, layer.name)
