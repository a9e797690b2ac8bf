"""Presets of the unwrap's options, the same files in the sidebar and the dialog as in the redo panel."""

import bpy
from bl_ui.utils import PresetPanel

from .operators import UV_OT_conformal_unwrap, chosen_options

OPERATOR = UV_OT_conformal_unwrap.__name__


class UV_PT_conformal_presets(PresetPanel, bpy.types.Panel):
    """Options of the unwrap, kept by name"""

    bl_label = "Presets"
    preset_subdir = f"operator/{UV_OT_conformal_unwrap.bl_idname}"
    preset_operator = "script.execute_preset"
    preset_add_operator = "uv.conformal_preset_add"

    def draw(self, context):
        """As Blender's popovers of presets, which set the properties of what they call the active operator."""
        self.layout.context_pointer_set("active_operator", chosen_options(context))
        super().draw(context)


class UV_OT_conformal_preset_add(bpy.types.Operator):
    """Keep the options under a name, or remove the preset.
    The redo panel's presets are the same"""

    bl_idname = "uv.conformal_preset_add"
    bl_label = "Add or Remove Preset"
    bl_options = {"INTERNAL"}

    name: bpy.props.StringProperty(name="Name", description="Of the preset", options={"SKIP_SAVE"})
    remove_name: bpy.props.BoolProperty(options={"HIDDEN", "SKIP_SAVE"})
    remove_active: bpy.props.BoolProperty(options={"HIDDEN", "SKIP_SAVE"})

    def execute(self, context):
        with context.temp_override(active_operator=chosen_options(context)):
            return bpy.ops.wm.operator_preset_add(
                name=self.name, remove_name=self.remove_name, remove_active=self.remove_active, operator=OPERATOR
            )


def draw_presets(layout, context):
    """The popover of presets, in a row of its own."""
    row = layout.row()
    row.alignment = "RIGHT"
    row.popover(UV_PT_conformal_presets.__name__, text="Presets", icon="PRESET")


CLASSES = (UV_OT_conformal_preset_add, UV_PT_conformal_presets)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
