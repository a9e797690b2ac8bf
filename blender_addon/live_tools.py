"""The live tools in the UV editor: its UV menu, its toolbar, and key-map items that preferences may turn on."""

import sys
from pathlib import Path

import bpy

from .live_operator import UV_OT_conformal_live
from .slide_operator import UV_OT_conformal_slide
from .sphere_slide_operator import UV_OT_conformal_sphere_slide

ICONS = Path(__file__).parent / "icons"
OPERATORS = (UV_OT_conformal_slide, UV_OT_conformal_live, UV_OT_conformal_sphere_slide)
KEYMAP = "UV Editor"
LEFT_PRESS = {"type": "LEFTMOUSE", "value": "PRESS"}

_items = []


class ConformalSlideTool(bpy.types.WorkSpaceTool):
    bl_space_type = "IMAGE_EDITOR"
    bl_context_mode = "UV"
    bl_idname = "conformal_uv.slide"
    bl_label = "Conformal Slide"
    bl_description = "Drag what should go elsewhere in a disk, the wheel turns it; on a sphere the wheel magnifies"
    bl_icon = str(ICONS / "conformal_slide")
    bl_keymap = (
        (UV_OT_conformal_slide.bl_idname, LEFT_PRESS, None),
        (UV_OT_conformal_sphere_slide.bl_idname, LEFT_PRESS, None),  # where the first finds no disk
    )


class ConformalLiveTool(bpy.types.WorkSpaceTool):
    bl_space_type = "IMAGE_EDITOR"
    bl_context_mode = "UV"
    bl_idname = "conformal_uv.live"
    bl_label = "Conformal Live Pins"
    bl_description = "Drag a pinned UV, or a selected one on the boundary; the island follows"
    bl_icon = str(ICONS / "conformal_live")
    bl_keymap = ((UV_OT_conformal_live.bl_idname, LEFT_PRESS, None),)


TOOLS = (ConformalSlideTool, ConformalLiveTool)


def draw(self, context):
    layout = self.layout
    layout.separator()
    layout.operator_context = "INVOKE_DEFAULT"
    for operator in OPERATORS:
        layout.operator(operator.bl_idname)


def keymap_items():
    """Pairs of key map and item, for preferences to show; they are off and without a key until the user gives one."""
    return list(_items)


@bpy.app.handlers.persistent
def forget(*_):
    """Another file: no factorization of the last one is kept."""
    live_pins = sys.modules.get(f"{__package__}.live_pins")
    if live_pins is not None:
        live_pins.forget()


def draw_shortcuts(layout, context):
    """The tools' shortcuts, to be given keys, for the add-on's preferences."""
    import rna_keymap_ui

    configuration = context.window_manager.keyconfigs.user
    keymap = configuration.keymaps.get(KEYMAP)
    names = {operator.bl_idname for operator in OPERATORS}
    for item in [] if keymap is None else keymap.keymap_items:
        if item.idname in names:
            layout.context_pointer_set("keymap", keymap)
            rna_keymap_ui.draw_kmi([], configuration, keymap, item, layout, 0)


def register():
    for operator in OPERATORS:
        bpy.utils.register_class(operator)
    bpy.types.IMAGE_MT_uvs.append(draw)
    bpy.app.handlers.load_post.append(forget)
    for number, tool in enumerate(TOOLS):
        bpy.utils.register_tool(tool, separator=number == 0)
    configuration = bpy.context.window_manager.keyconfigs.addon
    if configuration is not None:  # in background there is none
        keymap = configuration.keymaps.new(name=KEYMAP, space_type="EMPTY")
        for operator in OPERATORS:
            item = keymap.keymap_items.new(operator.bl_idname, "NONE", "PRESS")
            item.active = False
            _items.append((keymap, item))


def unregister():
    for keymap, item in _items:
        keymap.keymap_items.remove(item)
    _items.clear()
    for tool in reversed(TOOLS):
        bpy.utils.unregister_tool(tool)
    bpy.app.handlers.load_post.remove(forget)
    bpy.types.IMAGE_MT_uvs.remove(draw)
    for operator in reversed(OPERATORS):
        bpy.utils.unregister_class(operator)
