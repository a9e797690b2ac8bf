"""Which UV map is meant, and whether there is room for it."""

from __future__ import annotations

import bpy

MOST_UV_LAYERS = 8
DEFAULT_LAYER = "UVMap"


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
