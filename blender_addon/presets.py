"""Presets of the unwrap's options, the same files in the sidebar and the dialog as in the redo panel."""

from pathlib import Path

import bpy
from bl_ui.utils import PresetPanel

from .operators import UV_OT_conformal_unwrap, chosen_options
from .properties import Options

SUBFOLDER = f"operator/{UV_OT_conformal_unwrap.bl_idname}"


class UV_PT_conformal_presets(PresetPanel, bpy.types.Panel):
    """Options of the unwrap, kept by name"""

    bl_label = "Presets"
    preset_subdir = SUBFOLDER
    preset_operator = "script.execute_preset"
    preset_add_operator = "uv.conformal_preset_add"

    def draw(self, context):
        """As Blender's popovers of presets, which set the properties of what they call the active operator."""
        layout = self.layout
        layout.context_pointer_set("active_operator", chosen_options(context))
        if bpy.utils.preset_paths(self.preset_subdir):
            super().draw(context)
            return
        row = layout.row()  # before the first one there is no folder, which Blender would call missing
        row.operator_context = "EXEC_DEFAULT"
        row.prop(context.window_manager, "preset_name", text="")
        row.operator(self.preset_add_operator, text="", icon="ADD").name = context.window_manager.preset_name


class UV_OT_conformal_preset_add(bpy.types.Operator):
    """A preset's file written or removed"""

    bl_idname = "uv.conformal_preset_add"
    bl_label = "Add or Remove Preset"
    bl_description = (
        "Keep the options under a name, or remove the preset.\nThe panel after an unwrap has the same presets"
    )
    bl_options = {"INTERNAL"}

    name: bpy.props.StringProperty(
        name="Name", description="Name of the preset.\nOne that there is already is replaced", options={"SKIP_SAVE"}
    )
    remove_name: bpy.props.BoolProperty(options={"HIDDEN", "SKIP_SAVE"})
    remove_active: bpy.props.BoolProperty(options={"HIDDEN", "SKIP_SAVE"})

    def execute(self, context):
        file = _file_of(self.name)
        if file is None:
            return {"CANCELLED"}
        try:
            if self.remove_name or self.remove_active:
                file.unlink()
            else:
                _write(file, chosen_options(context))
        except OSError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


def _file_of(name):
    """The user's file of a preset; None for a name that is none."""
    stem = bpy.path.clean_name(name.strip())
    folder = bpy.utils.user_resource("SCRIPTS", path=f"presets/{SUBFOLDER}", create=True)
    return Path(folder) / f"{stem}.py" if stem.strip("_") and folder else None


def _write(file, chosen):
    """As Blender writes presets of operators, which its own way of doing so fails at on Python 3.13."""
    lines = [f"op.{name} = {value!r}" for name, value in Options.of(chosen).as_arguments().items()]
    file.write_text("\n".join(["import bpy", "op = bpy.context.active_operator", "", *lines, ""]), encoding="utf-8")


CLASSES = (UV_OT_conformal_preset_add, UV_PT_conformal_presets)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
