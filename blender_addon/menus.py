"""Entries in Blender's menus, each once."""

import bpy

from .flatten import OBJECT_OT_conformal_flatten
from .live_tools import OPERATORS as LIVE
from .operators import UV_OT_conformal_unwrap_options, draw_unwraps
from .overlay import VIEW3D_OT_conformal_overlay
from .pack_operator import UV_OT_conformal_pack
from .sphere import OBJECT_OT_conformal_sphere

OVERLAYS = (  # menu entries: every overlay, by its identifier
    ("ANGLE", "Conformal Angle Distortion"),
    ("AREA", "Conformal Area Distortion"),
    ("NONE", "Conformal Distortion Off"),
)


def draw(self, context):
    self.layout.separator()
    draw_unwraps(self.layout)
    self.layout.operator(UV_OT_conformal_unwrap_options.bl_idname, text="Conformal Unwrap with Options...")


def draw_for_objects(self, context):
    draw(self, context)
    for operator in (UV_OT_conformal_pack, OBJECT_OT_conformal_sphere, OBJECT_OT_conformal_flatten):
        self.layout.operator(operator.bl_idname)


def draw_for_uvs(self, context):
    self.layout.separator()
    self.layout.operator_context = "INVOKE_DEFAULT"
    for operator in (UV_OT_conformal_pack, *LIVE):
        self.layout.operator(operator.bl_idname)


def draw_overlay(self, context):
    self.layout.separator()
    for quantity, text in OVERLAYS:
        self.layout.operator(VIEW3D_OT_conformal_overlay.bl_idname, text=text).quantity = quantity


def menus():
    """The UV editor's unwrap menu, which the 3D view's shows too since 4.3, and those of UVs, objects and views."""
    yield bpy.types.IMAGE_MT_uvs_unwrap, draw
    if bpy.app.version < (4, 3):
        yield bpy.types.VIEW3D_MT_uv_map, draw
    yield bpy.types.VIEW3D_MT_object, draw_for_objects
    yield bpy.types.IMAGE_MT_uvs, draw_for_uvs
    yield bpy.types.VIEW3D_MT_view, draw_overlay


def register():
    for menu, entry in menus():
        menu.append(entry)


def unregister():
    for menu, entry in menus():
        menu.remove(entry)
