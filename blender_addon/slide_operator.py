"""The operator Conformal Slide."""

import math

import bpy

from .dragged import Dragged, drag_refusal
from .edit_mode import target_objects
from .mouse import in_uv_editor, passes, redraw, uv_at, window_region
from .typed_numbers import TypedNumbers
from .words import shown, told

STEP, PRECISE = math.radians(5.0), 0.1  # of a notch of the wheel, and of everything while Shift is held
HELP = (
    "Drag: slide   Wheel: turn   Shift: precise   Numbers, Tab, R X Y: type   "
    "Enter, click: confirm   Esc, right click: cancel"
)


class UV_OT_conformal_slide(Dragged, bpy.types.Operator):
    """A disk's middle dragged elsewhere, and the disk turned, angles kept"""

    bl_idname = "uv.conformal_slide"
    bl_label = "Conformal Slide"
    bl_description = (
        "Slide what is in the middle of a disk elsewhere, and turn it, keeping angles.\n"
        "Drag what should go elsewhere; islands whose boundary is a circle can be slid"
    )
    bl_options = {"REGISTER", "UNDO"}

    center: bpy.props.FloatVectorProperty(
        name="Center",
        description="Where the middle of the disk goes, as a part of its radius.\n"
        "To give what matters more of the texture, slide it to the middle",
        size=2,
        min=-1.0,
        max=1.0,
        step=1,
        precision=3,
        options={"SKIP_SAVE"},
    )
    rotation: bpy.props.FloatProperty(
        name="Rotation",
        description="How far the disk is turned about its middle.\nAfter it was slid",
        subtype="ANGLE",
        options={"SKIP_SAVE"},
    )
    object_name: bpy.props.StringProperty(options={"HIDDEN", "SKIP_SAVE"})
    face: bpy.props.IntProperty(
        default=-1,
        description="A face of the only island to slide; -1: all selected ones",
        options={"HIDDEN", "SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context):
        why = drag_refusal(context)
        if why:
            cls.poll_message_set(why)
        return not why

    def execute(self, context):
        from .disks import NONE_FOUND, NONE_SELECTED, by_object, chosen_disks, find_disks, slid
        from .live_uvs import LiveUVs
        from .slide import Slide

        disks = find_disks(context, target_objects(context))
        chosen = chosen_disks(disks, self.object_name, self.face)
        if not chosen:
            self.report({"ERROR"}, told(NONE_SELECTED if disks else NONE_FOUND))
            return {"CANCELLED"}
        slide = Slide(complex(*self.center), self.rotation)
        if slide.center == 0 and slide.rotation == 0:
            return {"FINISHED"}
        live = LiveUVs(context, list({disk.ob: None for disk in chosen}))
        try:
            for ob, group in by_object(chosen):
                for disk in group:
                    disk.write(live.values[ob], disk.island.placed(slide.moebius))
                live.show(ob)
        except BaseException:
            live.restore()
            raise
        live.keep()
        self._report(slid(chosen, live.values))
        return {"FINISHED"}

    def invoke(self, context, event):
        from .disks import NONE_FOUND, NONE_SELECTED, chosen_disks, disk_under, find_disks
        from .sphere_slide import find_spheres, laid_out

        if not in_uv_editor(context):
            return self.execute(context)
        disks = find_disks(context, target_objects(context))
        self._by_press = event.type == "LEFTMOUSE" and event.value in {"PRESS", "CLICK_DRAG"}
        if not disks and self._by_press and laid_out(find_spheres(context, target_objects(context))):
            return {"PASS_THROUGH"}  # the tool slides spheres too; Blender asks in either order
        self._area, self._region = context.area, window_region(context.area)
        at = uv_at(self._region, event)
        under = disk_under(disks, at)
        chosen = [under] if under else chosen_disks(disks)
        if not chosen:
            self.report({"ERROR"}, told(NONE_SELECTED if disks else NONE_FOUND))
            return {"CANCELLED"}
        self.object_name, self.face = (under.ob.name, under.face) if under else ("", -1)
        self._start(context, chosen, at if under else None)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "MOUSEMOVE":
            self._drag(context, event)
        elif event.type in {"WHEELUPMOUSE", "WHEELDOWNMOUSE"} and not event.ctrl:
            step = STEP if event.type == "WHEELUPMOUSE" else -STEP
            self._slide.turn(step * (PRECISE if event.shift else 1.0))
            self._show(context)
        elif event.type in {"ESC", "RIGHTMOUSE"} and event.value == "PRESS":
            self.cancel(context)
            self.report({"INFO"}, told("Cancelled; nothing was changed"))
            return {"CANCELLED"}
        elif self._confirmed(event):
            return self._finish(context)
        elif event.value == "PRESS" and self._typed.take(event.type, event.ascii):
            if self._typed.value is not None:
                self._slide.put(self._typed.field, self._typed.value)
            self._show(context)
        elif passes(event):
            return {"PASS_THROUGH"}
        return {"RUNNING_MODAL"}

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(self, "center")
        layout.prop(self, "rotation")

    def _start(self, context, chosen, grip):
        from .disks import circle, in_disk
        from .live_uvs import LiveUVs
        from .slide import Slide
        from .uv_overlay import UVOverlay, line_pairs

        self._chosen, self._slide = chosen, Slide()
        self._typed = TypedNumbers(("rotation", "x", "y"))
        lead = chosen[0]
        self._slide.grip_at(0j if grip is None else in_disk(lead, grip))
        self._last = None
        self._live = LiveUVs(context, list({disk.ob: None for disk in chosen}))
        self._overlay = UVOverlay()
        self._pairs = [line_pairs(disk.island.sides) for disk in chosen]
        self._overlay.rims = [circle(disk) for disk in chosen]
        self._show(context)

    def _drag(self, context, event):
        from .disks import in_disk

        lead = self._chosen[0]
        here = in_disk(lead, uv_at(self._region, event))
        if self._last is not None and here != self._last:
            self._slide.drag((here - self._last) * (PRECISE if event.shift else 1.0))
            self._show(context)
        self._last = here

    def _show(self, context):
        """Write and draw the present state."""
        from .disks import by_object, in_uv
        from .uv_overlay import CENTER

        moebius = self._slide.moebius
        placed = {disk: disk.island.placed(moebius) for disk in self._chosen}
        for ob, group in by_object(self._chosen):
            for disk in group:
                disk.write(self._live.values[ob], placed[disk])
            self._live.show(ob)
        self._overlay.edges = list(zip(placed.values(), self._pairs, strict=True))
        middle = complex(self._slide.center)
        self._overlay.points = [([in_uv(disk, middle) for disk in self._chosen], CENTER)]
        number, center = self._typed.shown, self._slide.center
        text = shown(
            "Rotation {rotation}°   X {x}   Y {y}",
            rotation=number("rotation", math.degrees(self._slide.rotation), 1),
            x=number("x", center.real),
            y=number("y", center.imag),
        )
        self._area.header_text_set(f"{shown('Conformal Slide')}   {text}")
        context.workspace.status_text_set(f"{text}      {shown(HELP)}")
        redraw(context, "IMAGE_EDITOR")

    def _finish(self, context):
        from .disks import slid

        self.center = (self._slide.center.real, self._slide.center.imag)
        self.rotation = self._slide.rotation
        self._live.keep()
        self._report(slid(self._chosen, self._live.values))
        self._end(context)
        return {"FINISHED"}

    def _end(self, context):
        self._live = None
        self._overlay.remove()
        self._area.header_text_set(None)
        if context.workspace is not None:
            context.workspace.status_text_set(None)
        redraw(context, "IMAGE_EDITOR")

    def _report(self, message):
        self.report({"WARNING"} if ";" in message else {"INFO"}, message)
