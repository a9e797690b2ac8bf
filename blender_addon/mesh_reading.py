"""Blender meshes as arrays; nothing is decided here."""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import blake2b

import bpy
import numpy as np
from numpy.typing import NDArray

from .mesh_attributes import first_corners, read_attribute


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
        read_attribute(mesh, "position", "vector", np.float32, len(mesh.vertices), 3),
        read_attribute(mesh, ".corner_vert", "value", np.int32, k),
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
    corners = read_attribute(mesh, ".corner_vert", "value", np.int32, k)
    selected = read_attribute(mesh, ".select_poly", "value", np.bool_, p)
    hidden = read_attribute(mesh, ".hide_poly", "value", np.bool_, p)
    pinned = read_attribute(mesh, f".pn.{uv_layer}", "value", np.bool_, k)
    starts = first_corners(mesh, p, k)
    if pinned.any():
        pinned &= np.repeat(~hidden, np.diff(starts))
    pinned_faces = np.zeros(p, dtype=bool)
    pinned_faces[np.repeat(np.arange(p), np.diff(starts))[pinned]] = True
    return MeshArrays(
        V=read_attribute(mesh, "position", "vector", np.float32, len(mesh.vertices), 3),
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
    return read_attribute(mesh, name, "value", np.bool_, len(mesh.loops))


def read_corner_flags(mesh: bpy.types.Mesh, name: str) -> NDArray[np.bool_]:
    """A boolean attribute of corners, (k,)."""
    return read_attribute(mesh, name, "value", np.bool_, len(mesh.loops))


def read_selected_vertices(mesh: bpy.types.Mesh) -> NDArray[np.bool_]:
    """Which vertices are selected, (n,)."""
    return read_attribute(mesh, ".select_vert", "value", np.bool_, len(mesh.vertices))


def read_corner_edges(mesh: bpy.types.Mesh) -> NDArray[np.int32]:
    """The edge of every corner, (k,)."""
    return read_attribute(mesh, ".corner_edge", "value", np.int32, len(mesh.loops))


def read_uv(mesh: bpy.types.Mesh, uv_layer: str) -> NDArray[np.float32]:
    """UVs of every corner, (k, 2); zeros where there is no such layer."""
    return read_attribute(mesh, uv_layer, "vector", np.float32, len(mesh.loops), 2)


def _alone(mesh: bpy.types.Mesh, of_selected_faces: NDArray[np.int32]) -> NDArray[np.int32]:
    """Selected vertices other than these."""
    alone = read_attribute(mesh, ".select_vert", "value", np.bool_, len(mesh.vertices))
    alone[of_selected_faces] = False
    return np.flatnonzero(alone).astype(np.int32)


def _seams(mesh: bpy.types.Mesh, k: int) -> NDArray[np.int32]:
    """Vertices of the seams that are edges of faces, (s, 2)."""
    count = len(mesh.edges)
    name = "uv_seam" if mesh.attributes.get("uv_seam") is not None else ".uv_seam"
    seam = read_attribute(mesh, name, "value", np.bool_, count)
    if not seam.any():
        return np.empty((0, 2), dtype=np.int32)
    of_face = np.zeros(count, dtype=bool)
    of_face[read_corner_edges(mesh)] = True
    return read_attribute(mesh, ".edge_verts", "value", np.int32, count, 2)[seam & of_face]
