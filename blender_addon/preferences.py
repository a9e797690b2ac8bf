"""The add-on's preferences: with which options the first unwrap of a session starts, and shortcuts."""

import bpy

from . import keymaps
from .operators import chosen_options
from .options_layout import means_something
from .properties import UnwrapProperties

NAMES = (  # of options that have a default here
    "shape",
    "method",
    "place",
    "margin",
    "margin_method",
    "image_size",
    "pack_rotation",
    "pack_shape",
)


def _start_again(preferences, context):
    """A default was changed: it counts at once."""
    start_with(preferences, context)


def _property(name, **other):
    """The operator's own property, declared once, with something else about it."""
    # Not of vars(cls), which has no annotations from Python 3.14 on until they are asked for.
    (declared,) = (cls.__annotations__[name] for cls in UnwrapProperties.__mro__ if _declares(cls, name))
    return declared.function(**{**declared.keywords, "update": _start_again, **other})


def _declares(cls, name):
    return name in getattr(cls, "__annotations__", {})


class ConformalUnwrapPreferences(bpy.types.AddonPreferences):
    """Defaults of options, and shortcuts"""

    bl_idname = __package__

    shape: _property("shape", default="FREE")
    method: _property("method")
    place: _property("place")
    margin: _property("margin")
    margin_method: _property("margin_method")
    image_size: _property("image_size")
    pack_rotation: _property("pack_rotation")
    pack_shape: _property("pack_shape")

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        column = layout.column(heading="")
        column.label(text="The first unwrap from the window starts with")
        for name in NAMES:
            if means_something(name, self):
                column.prop(self, name)
        layout.separator()
        layout.label(text="Shortcuts")
        keymaps.draw(layout, context)


def start_with(preferences, context):
    """Let the next unwrap from the window have these defaults."""
    chosen = chosen_options(context)
    for name in NAMES:
        setattr(chosen, name, getattr(preferences, name))


@bpy.app.handlers.persistent
def start(*_):
    """At start and in a new file. Blender forgets operators' last options only after it has told of the file."""
    _start_now()
    if not bpy.app.background:
        bpy.app.timers.register(_start_now, persistent=True)


def _start_now():
    addon = bpy.context.preferences.addons.get(__package__)
    if addon is not None and addon.preferences is not None:
        start_with(addon.preferences, bpy.context)


def register():
    bpy.utils.register_class(ConformalUnwrapPreferences)
    bpy.app.handlers.load_post.append(start)
    start()


def unregister():
    bpy.app.handlers.load_post.remove(start)
    bpy.utils.unregister_class(ConformalUnwrapPreferences)
