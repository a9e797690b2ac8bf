"""Blender meshes as arrays, and UVs back into them; nothing is decided here.

Everything goes through foreach_get and foreach_set on attributes, whose arrays must be flat and of Blender's own
types (float32, int32, bool).
"""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import blake2b

import bpy
import numpy as np
from numpy.typing import NDArray

MOST_UV_LAYERS = 8
DEFAULT_LAYER = "UVMap"
TYPES = {("f", 3): "FLOAT_VECTOR", ("f", 2): "FLOAT2", ("i", 1): "INT", ("i", 2): "INT32_2D", ("b", 1): "BOOLEAN"}


@dataclass(frozen=True, eq=False)
class MeshArrays:
    """What an unwrap reads of a mesh.

    Attributes
    ----------
    V : (n, 3) float32
    corners : (k,) int32
        Vertex of every corner.
    starts : (p + 1,) int32
        First corner of every face, and k.
    seams : (s, 2) int32
        Edges of faces that are marked as seams.
    selected : (p,) bool
    hidden : (p,) bool
    pins : (q,) int32
        Vertices of visible faces whose UV is pinned.
    pinned : (p,) bool
        Visible faces with a pinned UV.
    alone : (a,) int32
        Selected vertices of no selected face.
    pin_corners : (q,) int64
        Corners of visible faces whose UV is pinned.
    pin_places : (q, 2) float32
        Where they are.
    """

    V: NDArray[np.float32]
    corners: NDArray[np.int32]
    starts: NDArray[np.int32]
    seams: NDArray[np.int32]
    selected: NDArray[np.bool_]
    hidden: NDArray[np.bool_]
    pins: NDArray[np.int32]
    pinned: NDArray[np.bool_]
    alone: NDArray[np.int32]
    pin_corners: NDArray[np.int64]
    pin_places: NDArray[np.float32]

    def digest(self, chosen: NDArray[np.bool_]) -> bytes:
        """A fingerprint of the surface, its seams and the chosen faces (p,)."""
        hashed = blake2b(digest_size=20)
        for array in (self.V, self.corners, self.starts, self.seams, np.packbits(chosen)):
            hashed.update(str(array.shape).encode())
            hashed.update(np.ascontiguousarray(array).data)
        return hashed.digest()


def fingerprint(mesh: bpy.types.Mesh, uv_layer: str) -> bytes:
    """Of what a map's numbers depend on: positions, corners and UVs of a mesh that is not in Edit Mode."""
    k = len(mesh.loops)
    hashed = blake2b(str(len(mesh.polygons)).encode(), digest_size=20)
    for array in (
        _attribute(mesh, "position", "vector", np.float32, len(mesh.vertices), 3),
        _attribute(mesh, ".corner_vert", "value", np.int32, k),
        read_uv(mesh, uv_layer),
    ):
        hashed.update(str(array.shape).encode())
        hashed.update(np.ascontiguousarray(array).data)
    return hashed.digest()


def read_mesh(mesh: bpy.types.Mesh, uv_layer: str) -> MeshArrays:
    """The arrays of a mesh that is not in Edit Mode.

    Parameters
    ----------
    uv_layer : str
        Layer whose pins are read; none where there is no such layer.
    """
    p, k = len(mesh.polygons), len(mesh.loops)
    corners = _attribute(mesh, ".corner_vert", "value", np.int32, k)
    selected = _attribute(mesh, ".select_poly", "value", np.bool_, p)
    hidden = _attribute(mesh, ".hide_poly", "value", np.bool_, p)
    pinned = _attribute(mesh, f".pn.{uv_layer}", "value", np.bool_, k)
    starts = _starts(mesh, p, k)
    if pinned.any():
        pinned &= np.repeat(~hidden, np.diff(starts))
    pinned_faces = np.zeros(p, dtype=bool)
    pinned_faces[np.repeat(np.arange(p), np.diff(starts))[pinned]] = True
    return MeshArrays(
        V=_attribute(mesh, "position", "vector", np.float32, len(mesh.vertices), 3),
        corners=corners,
        starts=starts,
        seams=_seams(mesh, k),
        selected=selected,
        hidden=hidden,
        pins=corners[pinned],
        pinned=pinned_faces,
        alone=_alone(mesh, corners[np.repeat(selected & ~hidden, np.diff(starts))]),
        pin_corners=np.flatnonzero(pinned),
        pin_places=read_uv(mesh, uv_layer)[pinned] if pinned.any() else np.empty((0, 2), dtype=np.float32),
    )


def selected_uvs(mesh: bpy.types.Mesh) -> NDArray[np.bool_]:
    """Corners whose UV is selected, (k,), as the UV editor shows it where it does not follow the mesh's selection."""
    active = mesh.uv_layers.active
    name = ".uv_select_vert" if bpy.app.version >= (5, 0, 0) else f".vs.{active.name if active else ''}"
    return _attribute(mesh, name, "value", np.bool_, len(mesh.loops))


def read_corner_flags(mesh: bpy.types.Mesh, name: str) -> NDArray[np.bool_]:
    """A boolean attribute of corners, (k,)."""
    return _attribute(mesh, name, "value", np.bool_, len(mesh.loops))


def read_selected_vertices(mesh: bpy.types.Mesh) -> NDArray[np.bool_]:
    """Which vertices are selected, (n,)."""
    return _attribute(mesh, ".select_vert", "value", np.bool_, len(mesh.vertices))


def read_corner_edges(mesh: bpy.types.Mesh) -> NDArray[np.int32]:
    """The edge of every corner, (k,)."""
    return _attribute(mesh, ".corner_edge", "value", np.int32, len(mesh.loops))


def read_uv(mesh: bpy.types.Mesh, uv_layer: str) -> NDArray[np.float32]:
    """UVs of every corner, (k, 2); zeros where there is no such layer."""
    return _attribute(mesh, uv_layer, "vector", np.float32, len(mesh.loops), 2)


def uv_layer_name(mesh: bpy.types.Mesh, wanted: str) -> str:
    """The layer meant by a name that may be empty: the active one, or one that is still to be made."""
    if wanted:
        return wanted
    active = mesh.uv_layers.active
    return active.name if active is not None else DEFAULT_LAYER


def has_room(mesh: bpy.types.Mesh, uv_layer: str) -> bool:
    """Whether the layer exists or can be made."""
    there = mesh.uv_layers.get(uv_layer) is not None or holds_vectors(mesh, uv_layer)
    return there or len(mesh.uv_layers) < MOST_UV_LAYERS


def holds_vectors(mesh: bpy.types.Mesh, name: str) -> bool:
    """Whether there is a 3D vector attribute of corners of this name, which can hold UVs, too."""
    attribute = mesh.attributes.get(name)
    return attribute is not None and (attribute.domain, attribute.data_type) == ("CORNER", "FLOAT_VECTOR")


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
    corner = np.repeat(faces, np.diff(_starts(mesh, len(mesh.polygons), len(mesh.loops))))
    vertices, edges = np.zeros(len(mesh.vertices), dtype=bool), np.zeros(len(mesh.edges), dtype=bool)
    vertices[_attribute(mesh, ".corner_vert", "value", np.int32, len(mesh.loops))[corner]] = True
    edges[read_corner_edges(mesh)[corner]] = True
    _write_flags(mesh, ".select_vert", "POINT", vertices)
    _write_flags(mesh, ".select_edge", "EDGE", edges)
    _write_flags(mesh, ".select_poly", "FACE", faces)
    mesh.update()


def write_face_floats(mesh: bpy.types.Mesh, name: str, values: NDArray[np.float64]) -> None:
    """Set a float attribute of faces (p,), in Object Mode; made when missing."""
    _attribute_of(mesh, name, "FLOAT", "FACE").data.foreach_set("value", np.ascontiguousarray(values, dtype=np.float32))
    mesh.update()


def write_colors(mesh: bpy.types.Mesh, name: str, colors: NDArray[np.float64]) -> None:
    """Set a colour attribute of corners by sRGB (k, 3), in Object Mode; made when missing, and the active one then."""
    attribute = _attribute_of(mesh, name, "BYTE_COLOR", "CORNER")
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
    mesh.polygons.foreach_set("loop_start", _starts(source, p, k)[:p])
    mesh.update(calc_edges=True)
    slots = np.empty(p, dtype=np.int32)
    source.polygons.foreach_get("material_index", slots)
    mesh.polygons.foreach_set("material_index", slots)
    for material in source.materials:
        mesh.materials.append(material)
    layer = source.uv_layers.active.name
    mesh.uv_layers.new(name=layer).uv.foreach_set("vector", read_uv(source, layer).reshape(-1))
    _attribute_of(mesh, "conformal_vertex", "INT", "POINT").data.foreach_set("value", vertex.astype(np.int32))
    mesh.update()
    return mesh


def _attribute_of(mesh: bpy.types.Mesh, name: str, kind: str, domain: str) -> bpy.types.Attribute:
    """The attribute of this name, type and domain: made, or made anew where it is of another."""
    attribute = mesh.attributes.get(name)
    if attribute is not None and (attribute.data_type != kind or attribute.domain != domain):
        mesh.attributes.remove(attribute)
        attribute = None
    return mesh.attributes.new(name, kind, domain) if attribute is None else attribute


def _write_flags(mesh: bpy.types.Mesh, name: str, domain: str, values: NDArray[np.bool_]) -> None:
    """Set a boolean attribute. Blender 5.0's Mesh.update makes `.select_edge` of another type: that one is replaced."""
    attribute = mesh.attributes.get(name)
    if attribute is not None and attribute.data_type != "BOOLEAN":
        mesh.attributes.remove(attribute)
        attribute = None
    if attribute is None:
        attribute = mesh.attributes.new(name, "BOOLEAN", domain)
    attribute.data.foreach_set("value", values)


def _attribute(
    mesh: bpy.types.Mesh, name: str, field: str, dtype: type, count: int, width: int = 1
) -> NDArray[np.generic]:
    """Values of an attribute, (count,) or (count, width).

    Zeros where there is none of this type: Blender drops those that are all False.
    """
    attribute = mesh.attributes.get(name)
    values = np.zeros(count * width, dtype=dtype)
    if attribute is not None and count and attribute.data_type == TYPES[np.dtype(dtype).kind, width]:
        attribute.data.foreach_get(field, values)
    return values if width == 1 else values.reshape(count, width)


def _alone(mesh: bpy.types.Mesh, of_selected_faces: NDArray[np.int32]) -> NDArray[np.int32]:
    """Selected vertices other than these."""
    alone = _attribute(mesh, ".select_vert", "value", np.bool_, len(mesh.vertices))
    alone[of_selected_faces] = False
    return np.flatnonzero(alone).astype(np.int32)


def _starts(mesh: bpy.types.Mesh, p: int, k: int) -> NDArray[np.int32]:
    if k == 3 * p:  # faces have three corners or more: these have three
        return np.arange(0, k + 1, 3, dtype=np.int32)
    starts = np.empty(p + 1, dtype=np.int32)
    mesh.polygons.foreach_get("loop_start", starts[:p])
    starts[p] = k
    return starts


def _seams(mesh: bpy.types.Mesh, k: int) -> NDArray[np.int32]:
    """Vertices of the seams that are edges of faces, (s, 2)."""
    count = len(mesh.edges)
    name = "uv_seam" if mesh.attributes.get("uv_seam") is not None else ".uv_seam"
    seam = _attribute(mesh, name, "value", np.bool_, count)
    if not seam.any():
        return np.empty((0, 2), dtype=np.int32)
    of_face = np.zeros(count, dtype=bool)
    of_face[read_corner_edges(mesh)] = True
    return _attribute(mesh, ".edge_verts", "value", np.int32, count, 2)[seam & of_face]
