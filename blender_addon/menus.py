"""Entries in Blender's menus, each once."""

import bpy

from .operators import UV_OT_conformal_unwrap_options, draw_unwraps
from .sphere import OBJECT_OT_conformal_sphere


def draw(self, context):
    self.layout.separator()
    draw_unwraps(self.layout)
    self.layout.operator(UV_OT_conformal_unwrap_options.bl_idname, text="Conformal Unwrap with Options...")


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
