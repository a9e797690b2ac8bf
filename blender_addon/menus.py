"""Entries in Blender's menus, each once."""

import bpy

from .operators import UV_OT_conformal_unwrap
from .sphere import OBJECT_OT_conformal_sphere

UNWRAPS = (  # the commonest first
    ("FREE", "Conformal Unwrap"),
    ("DISK", "Conformal Disk Unwrap"),
    ("RECTANGLE", "Conformal Rectangle Unwrap"),
)


def draw(self, context):
    layout = self.layout
    layout.operator_context = "INVOKE_DEFAULT"
    layout.separator()
    for shape, text in UNWRAPS:
        layout.operator(UV_OT_conformal_unwrap.bl_idname, text=text).shape = shape


def draw_for_objects(self, context):
    draw(self, context)
    self.layout.operator(OBJECT_OT_conformal_sphere.bl_idname)


def menus():
    """The UV editor's unwrap menu, which the 3D view's shows too since 4.3, and the menu of objects."""
    yield bpy.types.IMAGE_MT_uvs_unwrap, draw
    if bpy.app.version < (4, 3):
        yield bpy.types.VIEW3D_MT_uv_map, draw
    yield bpy.types.VIEW3D_MT_object, draw_for_objects


def register():
    for menu, entry in menus():
        menu.append(entry)


def unregister():
    for menu, entry in menus():
        menu.remove(entry)
