"""Shortcuts that the add-on offers; all are switched off until the preferences switch them on."""

import bpy

OFFERED = (  # keymap, its space, operator, its properties, key, modifiers
    ("UV Editor", "EMPTY", "uv.conformal_unwrap", {}, "U", {"ctrl": True, "shift": True}),
    ("UV Editor", "EMPTY", "uv.conformal_unwrap_options", {}, "U", {"ctrl": True, "alt": True}),
    *(
        ("UV Editor", "EMPTY", operator, {}, "NONE", {})  # for the user to choose a key
        for operator in ("uv.conformal_slide", "uv.conformal_live", "uv.conformal_sphere_slide", "uv.conformal_pack")
    ),
    ("Mesh", "EMPTY", "uv.conformal_unwrap", {}, "U", {"ctrl": True, "shift": True}),
    ("Mesh", "EMPTY", "uv.conformal_unwrap_options", {}, "U", {"ctrl": True, "alt": True}),
)
PREFIXES = ("uv.conformal_", "object.conformal_", "view3d.conformal_")  # of the add-on's operators

_made = []


def draw(layout, context):
    """The shortcuts of all the add-on's operators, to be edited."""
    import rna_keymap_ui

    user = context.window_manager.keyconfigs.user
    for keymap in user.keymaps if user is not None else ():
        items = [item for item in keymap.keymap_items if item.idname.startswith(PREFIXES)]
        if not items:
            continue
        column = layout.column()
        column.label(text=keymap.name)
        column.context_pointer_set("keymap", keymap)
        for item in items:
            rna_keymap_ui.draw_kmi([], user, keymap, item, column, 0)


def register():
    keyconfig = bpy.context.window_manager.keyconfigs.addon
    if keyconfig is None:  # in background
        return
    for name, space, operator, properties, key, modifiers in OFFERED:
        keymap = keyconfig.keymaps.new(name=name, space_type=space)
        item = keymap.keymap_items.new(operator, key, "PRESS", **modifiers)
        for option, value in properties.items():
            setattr(item.properties, option, value)
        item.active = False
        _made.append((keymap, item))


def unregister():
    for keymap, item in _made:
        keymap.keymap_items.remove(item)
    _made.clear()
