"""The live tools: their operators, and the UV editor's toolbar."""

import sys
from pathlib import Path

import bpy

from .live_operator import UV_OT_conformal_live
from .slide_operator import UV_OT_conformal_slide
from .sphere_slide_operator import UV_OT_conformal_sphere_slide

ICONS = Path(__file__).parent / "icons"
OPERATORS = (UV_OT_conformal_slide, UV_OT_conformal_live, UV_OT_conformal_sphere_slide)
LEFT_PRESS = {"type": "LEFTMOUSE", "value": "PRESS"}


class ConformalSlideTool(bpy.types.WorkSpaceTool):
    bl_space_type = "IMAGE_EDITOR"
    bl_context_mode = "UV"
    bl_idname = "conformal_uv.slide"
    bl_label = "Conformal Slide"
    bl_description = (
        "Drag what should go elsewhere in a disk, the wheel turns it.\nOn a sphere the wheel magnifies what it is over"
    )
    bl_icon = str(ICONS / "conformal_slide")
    bl_keymap = (
        (UV_OT_conformal_slide.bl_idname, LEFT_PRESS, None),
        (UV_OT_conformal_sphere_slide.bl_idname, LEFT_PRESS, None),  # one of them finds what it slides
    )


class ConformalLiveTool(bpy.types.WorkSpaceTool):
    bl_space_type = "IMAGE_EDITOR"
    bl_context_mode = "UV"
    bl_idname = "conformal_uv.live"
    bl_label = "Conformal Live Pins"
    bl_description = "Drag a pinned UV, or a selected one on the boundary.\nThe island follows, its other pins stay"
    bl_icon = str(ICONS / "conformal_live")
    bl_keymap = ((UV_OT_conformal_live.bl_idname, LEFT_PRESS, None),)


TOOLS = (ConformalSlideTool, ConformalLiveTool)


@bpy.app.handlers.persistent
def forget(*_):
    """Another file: no factorization of the last one is kept."""
    live_pins = sys.modules.get(f"{__package__}.live_pins")
    if live_pins is not None:
        live_pins.forget()


def register():
    for operator in OPERATORS:
        bpy.utils.register_class(operator)
    bpy.app.handlers.load_post.append(forget)
    for number, tool in enumerate(TOOLS):
        bpy.utils.register_tool(tool, separator=number == 0)


def unregister():
    for tool in reversed(TOOLS):
        bpy.utils.unregister_tool(tool)
    bpy.app.handlers.load_post.remove(forget)
    for operator in reversed(OPERATORS):
        bpy.utils.unregister_class(operator)
