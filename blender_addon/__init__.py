"""Conformal Unwrap, a Blender extension: UV islands unrolled, or brought to disks and rectangles, angles kept.

All mathematics is in the package conformal_uv: beside this one in a checkout, inside it in the built extension.
"""

import bpy

from . import (
    command,
    flatten,
    keymaps,
    last_result,
    live_tools,
    manual,
    menus,
    operators,
    overlay,
    pack_operator,
    panel,
    preferences,
    presets,
    sphere,
    staleness,
    translations,
)

MODULES = (
    translations,
    operators,
    pack_operator,
    overlay,
    flatten,
    sphere,
    presets,
    panel,
    menus,
    live_tools,
    keymaps,
    preferences,
    staleness,
    manual,
    command,
)


@bpy.app.handlers.persistent
def forget(*_):
    """Another file: nothing of the last one is shown or kept."""
    last_result.forget()
    command.forget_work()


def register():
    for module in MODULES:
        module.register()
    bpy.app.handlers.load_post.append(forget)


def unregister():
    bpy.app.handlers.load_post.remove(forget)
    for module in reversed(MODULES):
        module.unregister()
    forget()
