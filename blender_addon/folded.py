"""Faces whose UVs are inverted or collapsed, found in the UVs as Blender stores them."""

from __future__ import annotations

import bpy
import numpy as np
from numpy.typing import NDArray

from conformal_uv import flipped_polygons

from .face_selection import mapped_mesh


def folded_faces(mesh: bpy.types.Mesh) -> NDArray[np.bool_]:
    """Visible faces with a triangle of no positive area in the active UV map, (p,); none without a UV map."""
    folded = np.zeros(len(mesh.polygons), dtype=bool)
    found = mapped_mesh(mesh)
    if found is not None:
        arrays, polygons, uv = found
        folded[flipped_polygons(polygons, uv)] = True
        folded &= ~arrays.hidden
    return folded
