"""The sidebar of the UV editor and of the 3D view: shape, options and presets before the unwrap, its numbers after."""

from dataclasses import replace

import bpy

from . import last_result
from .advice import advice_for
from .operators import (
    UV_OT_conformal_select_folded,
    UV_OT_conformal_select_worst,
    UV_OT_conformal_unwrap,
    chosen_options,
)
from .options_layout import draw_options
from .presets import UV_PT_conformal_presets
from .words import counted, shown, told
from .worker import under_way

MOST_OBJECTS = 8
LINE = 0.11  # characters of a line for a pixel of the sidebar's width, about


class _Sidebar:
    """Where the panels are."""

    bl_region_type = "UI"
    bl_category = "Conformal UV"

    @classmethod
    def poll(cls, context):
        return context.area.ui_type == "UV" or context.mode in {"OBJECT", "EDIT_MESH"}


class _Unwrap(_Sidebar):
    bl_label = "Conformal Unwrap"

    def draw(self, context):
        layout, chosen = self.layout, chosen_options(context)
        layout.row(align=True).prop(chosen, "shape", expand=True)
        row = layout.row()
        row.scale_y = 1.4
        row.operator_context = "INVOKE_DEFAULT"
        row.operator(UV_OT_conformal_unwrap.bl_idname, text="Unwrap", icon="UV").shape = chosen.shape
        if under_way():
            layout.label(text="Esc: Cancel", icon="SORTTIME")


class _Options(_Sidebar):
    bl_label = "Options"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header_preset(self, context):
        UV_PT_conformal_presets.draw_panel_header(self.layout)

    def draw(self, context):
        draw_options(self.layout, chosen_options(context), with_shape=False)


class _Result(_Sidebar):
    bl_label = "Last Result"

    def draw(self, context):
        layout, result = self.layout, last_result.last()
        if result is None:
            layout.label(text="Nothing unwrapped yet")
        elif not last_result.measured():
            layout.label(text="Measuring ...", icon="SORTTIME")
        else:
            draw_result(layout, result, LINE * context.region.width)
        column = layout.column(align=True)
        column.operator(UV_OT_conformal_select_worst.bl_idname, icon="FACESEL")
        column.operator(UV_OT_conformal_select_folded.bl_idname, icon="FACESEL")


def draw_result(layout, result, width):
    """Numbers of all objects, whether they still hold, and what to do where they are poor."""
    if last_result.stale():
        draw_text(layout, told("Changed since then: these numbers are of the map as it was"), width, "ERROR")
    text = counted(
        result.islands,
        "{done} of {count} island, {seconds:.2f} s",
        "{done} of {count} islands, {seconds:.2f} s",
        done=result.unwrapped,
        seconds=result.seconds,
    )
    layout.label(text=text)
    numbers = layout.column()
    numbers.active = not last_result.stale()
    for ob in result.objects[:MOST_OBJECTS]:
        draw_object(numbers.box(), ob, width)
    if len(result.objects) > MOST_OBJECTS:
        numbers.label(text=told("and {count} more", count=len(result.objects) - MOST_OBJECTS))
    if not last_result.stale():
        for advice in advice_for(result):
            draw_advice(layout.box(), advice, result.options, width)


def draw_advice(layout, advice, options, width):
    """Words, and the button that does it."""
    draw_text(layout, advice.text, width, "INFO")
    if not advice.action:
        return
    row = layout.row()
    if not advice.changes:
        row.operator(UV_OT_conformal_select_worst.bl_idname, text=advice.action)
        return
    row.operator_context = "INVOKE_DEFAULT"
    button = row.operator(UV_OT_conformal_unwrap.bl_idname, text=advice.action)
    for name, value in replace(options, **advice.changes).as_arguments().items():
        setattr(button, name, value)


def draw_text(layout, text, width, icon):
    """A sentence over several lines."""
    import textwrap

    column = layout.column(align=True)
    for number, line in enumerate(textwrap.wrap(text, max(int(width), 20))):
        column.label(text=line, icon="BLANK1" if number else icon)


def draw_object(layout, ob, width):
    """Rows of name and number."""
    layout.label(text=ob.name, icon="MESH_DATA")
    if ob.refusal:
        draw_text(layout, ob.refusal, width, "ERROR")
        return
    column = layout.column(align=True)
    for name, value in rows(ob):
        split = column.split(factor=0.6)
        split.label(text=name)
        split.label(text=value)
    for failure in ob.failures[:MOST_OBJECTS]:
        draw_text(column, told("Face {face}: {why}", face=failure.faces[0], why=failure.why), width, "ERROR")


def rows(ob):
    """Names and texts of an object's numbers."""
    count = told("{done} of {count}", done=ob.islands - len(ob.failures), count=ob.islands)
    said = [(shown("Islands"), count)]
    quality = ob.quality
    if quality is not None:
        said += [
            (shown("Angle error, mean"), f"{quality.angle_mean:.3g}°"),
            (shown("Angle error, rms"), f"{quality.angle_rms:.3g}°"),
            (shown("Angle error, largest"), f"{quality.angle_max:.3g}°"),
            (shown("Area ratio"), "-" if quality.area_ratio is None else f"{quality.area_ratio:.3g}"),
            (shown("Texture covered"), "-" if ob.coverage is None else f"{100.0 * ob.coverage:.0f} %"),
            (shown("Flipped faces"), str(ob.flipped)),
            (shown("Too small to store"), str(ob.lost_to_float32)),
        ]
    return said


def _panels(space, prefix):
    """The panels for one editor: the first, and the others in it."""
    first = type(f"{prefix}_PT_conformal_unwrap", (_Unwrap, bpy.types.Panel), {"bl_space_type": space})
    yield first
    for name, base in (("options", _Options), ("result", _Result)):
        own = {"bl_space_type": space, "bl_parent_id": first.__name__}
        yield type(f"{prefix}_PT_conformal_{name}", (base, bpy.types.Panel), own)


CLASSES = (*_panels("IMAGE_EDITOR", "UV"), *_panels("VIEW_3D", "VIEW3D"))


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
