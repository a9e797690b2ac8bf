"""The sidebar panel of the UV editor: the operator's button and the last result's numbers."""

import bpy

from . import last_result
from .choices import SHAPES
from .operators import UV_OT_conformal_select_folded, UV_OT_conformal_unwrap

MOST_OBJECTS = 8


class UV_PT_conformal_unwrap(bpy.types.Panel):
    """Numbers of the last conformal unwrap"""

    bl_label = "Conformal Unwrap"
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "Conformal UV"

    @classmethod
    def poll(cls, context):
        return context.area.ui_type == "UV"

    def draw(self, context):
        layout = self.layout
        row = layout.row(align=True)
        row.operator_context = "INVOKE_DEFAULT"
        for shape, name, _ in SHAPES:
            row.operator(UV_OT_conformal_unwrap.bl_idname, text=name).shape = shape
        result = last_result.last()
        if result is None:
            layout.label(text="Nothing unwrapped yet")
        else:
            layout.label(text=f"{result.unwrapped} of {result.islands} islands, {result.seconds:.2f} s")
            for ob in result.objects[:MOST_OBJECTS]:
                draw_object(layout.box(), ob)
            if len(result.objects) > MOST_OBJECTS:
                layout.label(text=f"and {len(result.objects) - MOST_OBJECTS} more objects")
        layout.operator(UV_OT_conformal_select_folded.bl_idname, icon="FACESEL")


def draw_object(layout, ob):
    """Rows of name and number."""
    layout.label(text=ob.name, icon="MESH_DATA")
    if ob.refusal:
        layout.label(text=ob.refusal, icon="ERROR")
        return
    column = layout.column(align=True)
    for name, value in rows(ob):
        split = column.split(factor=0.55)
        split.label(text=name)
        split.label(text=value)
    for failure in ob.failures[:MOST_OBJECTS]:
        column.label(text=f"Face {failure.faces[0]}: {failure.why}", icon="ERROR")


def rows(ob):
    """Names and texts of an object's numbers."""
    told = [("Islands", f"{ob.islands - len(ob.failures)} of {ob.islands}")]
    quality = ob.quality
    if quality is not None:
        told += [
            ("Angle error, mean", f"{quality.angle_mean:.3g}°"),
            ("Angle error, rms", f"{quality.angle_rms:.3g}°"),
            ("Angle error, largest", f"{quality.angle_max:.3g}°"),
            ("Area ratio", "-" if quality.area_ratio is None else f"{quality.area_ratio:.3g}"),
            ("Texture covered", "-" if ob.coverage is None else f"{100.0 * ob.coverage:.0f} %"),
            ("Flipped faces", str(ob.flipped)),
            ("Lost to float32", str(ob.lost_to_float32)),
        ]
    return told


def register():
    bpy.utils.register_class(UV_PT_conformal_unwrap)


def unregister():
    bpy.utils.unregister_class(UV_PT_conformal_unwrap)
