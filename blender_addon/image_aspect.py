"""The shape of the image that an object's UVs are seen on."""

from __future__ import annotations

import bpy
import numpy as np
from numpy.typing import NDArray

from .properties import Options

ROUND = (1.0, 1.0)


def aspect_scale(ob: bpy.types.Object) -> tuple[float, float]:
    """Factors for u and v that keep a disk round on the image and within it; (1, 1) without an image."""
    image = _image(ob)
    if image is None or not image.size[0] or not image.size[1]:
        return ROUND
    width, height = image.size
    least = min(width, height)
    return least / width, least / height


def image_scale(ob: bpy.types.Object, options: Options) -> NDArray[np.float64]:
    """The same, (2,), where the options ask for it."""
    return np.array(aspect_scale(ob) if options.correct_aspect else ROUND)


def _image(ob: bpy.types.Object) -> bpy.types.Image | None:
    """The image of the active texture node in the active face's material, as Blender's own unwrap takes it."""
    number = ob.data.polygons.active
    faces = ob.data.polygons
    slot = faces[number].material_index if 0 <= number < len(faces) else ob.active_material_index
    if slot >= len(ob.material_slots):
        return None
    material = ob.material_slots[slot].material
    if material is None or material.node_tree is None:
        return None
    node = material.node_tree.nodes.active
    return node.image if node is not None and node.type == "TEX_IMAGE" else None
