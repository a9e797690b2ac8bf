"""Conformal Unwrap, a Blender extension: UV islands unrolled, or brought to disks and rectangles, angles kept.

All mathematics is in the package conformal_uv, which the extension brings as a wheel.
"""

import bpy

from . import (
    command,
    keymaps,
    last_result,
    manual,
    menus,
    operators,
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
    sphere,
    presets,
    panel,
    menus,
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
