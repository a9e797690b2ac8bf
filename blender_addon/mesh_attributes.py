"""Values of a mesh's attributes, whose arrays must be flat and of Blender's own types (float32, int32, bool)."""

from __future__ import annotations

import bpy
import numpy as np
from numpy.typing import NDArray

TYPES = {("f", 3): "FLOAT_VECTOR", ("f", 2): "FLOAT2", ("i", 1): "INT", ("i", 2): "INT32_2D", ("b", 1): "BOOLEAN"}


def read_attribute(
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


def attribute_of(mesh: bpy.types.Mesh, name: str, kind: str, domain: str) -> bpy.types.Attribute:
    """The attribute of this name, type and domain: made, or made anew where it is of another."""
    attribute = mesh.attributes.get(name)
    if attribute is not None and (attribute.data_type != kind or attribute.domain != domain):
        mesh.attributes.remove(attribute)
        attribute = None
    return mesh.attributes.new(name, kind, domain) if attribute is None else attribute


def first_corners(mesh: bpy.types.Mesh, p: int, k: int) -> NDArray[np.int32]:
    """First corner of each of p faces, and the number k of all corners, (p + 1,)."""
    if k == 3 * p:  # faces have three corners or more: these have three
        return np.arange(0, k + 1, 3, dtype=np.int32)
    starts = np.empty(p + 1, dtype=np.int32)
    mesh.polygons.foreach_get("loop_start", starts[:p])
    starts[p] = k
    return starts
