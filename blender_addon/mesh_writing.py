"""Arrays written into Blender meshes; nothing is decided here."""

from __future__ import annotations

import bpy
import numpy as np
from numpy.typing import NDArray

from .mesh_attributes import attribute_of, first_corners, read_attribute
from .mesh_reading import read_corner_edges, read_uv
from .uv_layers import holds_vectors


def write_uv(mesh: bpy.types.Mesh, uv_layer: str, uv: NDArray[np.float64], written: NDArray[np.bool_]) -> None:
    """Set the UVs of some corners, in Object Mode; all others keep theirs bit for bit.

    Parameters
    ----------
    uv_layer : str
        A UV map, made, and made active, when missing; or a 3D vector attribute of corners, whose third component
        becomes 0.
    uv : (k, 2)
    written : (k,) bool
    """
    width = 3 if holds_vectors(mesh, uv_layer) else 2
    if width == 2 and mesh.uv_layers.get(uv_layer) is None:
        mesh.uv_layers.active = mesh.uv_layers.new(name=uv_layer)
    values = np.empty((len(mesh.loops), width), dtype=np.float32)
    data = mesh.attributes[uv_layer].data
    data.foreach_get("vector", values.reshape(-1))
    values[written, 2:] = 0.0
    np.copyto(values[:, :2], uv, where=written[:, None], casting="same_kind")
    data.foreach_set("vector", values.reshape(-1))
    mesh.update()


def write_shape_key(ob: bpy.types.Object, name: str, positions: NDArray[np.float64]) -> None:
    """Set the positions (n, 3) of a shape key, in Object Mode, and slide to it; made when missing."""
    if ob.data.shape_keys is None:
        ob.shape_key_add(name="Basis", from_mix=False)
    key = ob.data.shape_keys.key_blocks.get(name)
    if key is None:
        key = ob.shape_key_add(name=name, from_mix=False)
    key.data.foreach_set("co", np.ascontiguousarray(positions, dtype=np.float32).reshape(-1))
    key.value = 1.0
    ob.data.update()


def write_selection(mesh: bpy.types.Mesh, faces: NDArray[np.bool_]) -> None:
    """Select these faces with their edges and vertices, and nothing else, in Object Mode."""
    corner = np.repeat(faces, np.diff(first_corners(mesh, len(mesh.polygons), len(mesh.loops))))
    vertices, edges = np.zeros(len(mesh.vertices), dtype=bool), np.zeros(len(mesh.edges), dtype=bool)
    vertices[read_attribute(mesh, ".corner_vert", "value", np.int32, len(mesh.loops))[corner]] = True
    edges[read_corner_edges(mesh)[corner]] = True
    _write_flags(mesh, ".select_vert", "POINT", vertices)
    _write_flags(mesh, ".select_edge", "EDGE", edges)
    _write_flags(mesh, ".select_poly", "FACE", faces)
    mesh.update()


def write_face_floats(mesh: bpy.types.Mesh, name: str, values: NDArray[np.float64]) -> None:
    """Set a float attribute of faces (p,), in Object Mode; made when missing."""
    attribute_of(mesh, name, "FLOAT", "FACE").data.foreach_set("value", np.ascontiguousarray(values, dtype=np.float32))
    mesh.update()


def write_colors(mesh: bpy.types.Mesh, name: str, colors: NDArray[np.float64]) -> None:
    """Set a colour attribute of corners by sRGB (k, 3), in Object Mode; made when missing, and the active one then."""
    attribute = attribute_of(mesh, name, "BYTE_COLOR", "CORNER")
    values = np.ones((len(colors), 4), dtype=np.float32)
    values[:, :3] = colors
    attribute.data.foreach_set("color_srgb", values.reshape(-1))
    mesh.color_attributes.active_color = mesh.color_attributes[name]
    mesh.update()


def flat_mesh(
    source: bpy.types.Mesh, V: NDArray[np.float64], corners: NDArray[np.int64], vertex: NDArray[np.int64]
) -> bpy.types.Mesh:
    """A new mesh of the same faces on other vertices, with their UV map, materials and normals' smoothness.

    The attribute `conformal_vertex` holds the vertex of the source that each is.

    Parameters
    ----------
    V : (n, 3)
    corners : (k,)
        Vertex of every corner of the source.
    vertex : (n,)
    """
    mesh = bpy.data.meshes.new(f"{source.name} Flat")
    p, k = len(source.polygons), len(source.loops)
    mesh.vertices.add(len(V))
    mesh.loops.add(k)
    mesh.polygons.add(p)
    mesh.attributes["position"].data.foreach_set("vector", np.ascontiguousarray(V, dtype=np.float32).reshape(-1))
    mesh.loops.foreach_set("vertex_index", corners.astype(np.int32))
    mesh.polygons.foreach_set("loop_start", first_corners(source, p, k)[:p])
    mesh.update(calc_edges=True)
    slots = np.empty(p, dtype=np.int32)
    source.polygons.foreach_get("material_index", slots)
    mesh.polygons.foreach_set("material_index", slots)
    for material in source.materials:
        mesh.materials.append(material)
    layer = source.uv_layers.active.name
    mesh.uv_layers.new(name=layer).uv.foreach_set("vector", read_uv(source, layer).reshape(-1))
    attribute_of(mesh, "conformal_vertex", "INT", "POINT").data.foreach_set("value", vertex.astype(np.int32))
    mesh.update()
    return mesh


def _write_flags(mesh: bpy.types.Mesh, name: str, domain: str, values: NDArray[np.bool_]) -> None:
    """Set a boolean attribute. Blender 5.0's Mesh.update makes `.select_edge` of another type: that one is replaced."""
    attribute = mesh.attributes.get(name)
    if attribute is not None and attribute.data_type != "BOOLEAN":
        mesh.attributes.remove(attribute)
        attribute = None
    if attribute is None:
        attribute = mesh.attributes.new(name, "BOOLEAN", domain)
    attribute.data.foreach_set("value", values)
