"""Entries in Blender's menus, each once."""

import bpy

from .operators import UV_OT_conformal_unwrap


def draw(self, context):
    layout = self.layout
    layout.operator_context = "INVOKE_DEFAULT"
    layout.separator()
    layout.operator(UV_OT_conformal_unwrap.bl_idname)


def menus():
    """The UV editor's unwrap menu, which the 3D view's shows too since 4.3, and the menu of objects."""
    yield bpy.types.IMAGE_MT_uvs_unwrap
    if bpy.app.version < (4, 3):
        yield bpy.types.VIEW3D_MT_uv_map
    yield bpy.types.VIEW3D_MT_object


def register():
    for menu in menus():
        menu.append(draw)


def unregister():
    for menu in menus():
        menu.remove(draw)
