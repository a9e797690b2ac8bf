"""The operator Conformal Sphere Slide."""

import bpy
from mathutils import Euler, Matrix

from .dragged import Dragged, drag_refusal
from .edit_mode import target_objects
from .mouse import in_uv_editor, passes, redraw, uv_at, window_region
from .typed_numbers import TypedNumbers
from .words import counted, shown, told

STEP, PRECISE = 0.1, 0.1  # logarithm of the scale of a notch of the wheel; of everything while Shift is held
HELP = (
    "Drag: turn   Wheel: magnify here   Shift: precise   Numbers, Tab, R X Y Z: type   "
    "Enter, click: confirm   Esc, right click: cancel"
)


class UV_OT_conformal_sphere_slide(Dragged, bpy.types.Operator):
    """A mesh's conformal sphere turned, and magnified where the mouse is, angles kept"""

    bl_idname = "uv.conformal_sphere_slide"
    bl_label = "Conformal Sphere Slide"
    bl_description = (
        "Turn the sphere that a closed mesh was mapped to, and magnify what lies under the mouse, keeping angles.\n"
        "Moves the shape key of Conformal Sphere Map and the UVs that were written with it"
    )
    bl_options = {"REGISTER", "UNDO"}

    toward: bpy.props.FloatVectorProperty(
        name="Toward",
        description="Where all points move to, the farther the longer it is (less than 1).\nWhat lies opposite grows",
        size=3,
        min=-1.0,
        max=1.0,
        step=1,
        precision=3,
        options={"SKIP_SAVE"},
    )
    rotation: bpy.props.FloatVectorProperty(
        name="Rotation",
        description="How the sphere is turned.\nBefore its points move",
        subtype="EULER",
        size=3,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context):
        why = drag_refusal(context)
        if why:
            cls.poll_message_set(why)
        return not why

    def execute(self, context):
        import numpy as np

        from conformal_uv import ConformalUVError, SphereMoebius

        from .sphere_slide import NONE_FOUND, LiveSpheres, find_spheres

        spheres = find_spheres(context, target_objects(context))
        if not spheres:
            self.report({"ERROR"}, told(NONE_FOUND))
            return {"CANCELLED"}
        try:
            moebius = SphereMoebius.of(self.toward, np.array(Euler(self.rotation).to_matrix()))
        except ConformalUVError as error:
            self.report({"ERROR"}, error.told(lambda remedy: ""))
            return {"CANCELLED"}
        live = LiveSpheres(context, spheres)
        try:
            live.show(moebius)
        except BaseException:
            live.restore()
            raise
        live.keep()
        self._tell(spheres)
        return {"FINISHED"}

    def invoke(self, context, event):
        from .disks import NONE_FOUND as NO_DISK
        from .disks import find_disks
        from .sphere_slide import NO_LAYOUT, NONE_FOUND, LiveSpheres, SphereSlide, find_spheres, laid_out

        if not in_uv_editor(context):
            return self.execute(context)
        self._spheres = find_spheres(context, target_objects(context))
        self._by_press = event.type == "LEFTMOUSE" and event.value in {"PRESS", "CLICK_DRAG"}
        flat = laid_out(self._spheres)
        if not flat:
            if self._by_press and find_disks(context, target_objects(context)):
                return {"PASS_THROUGH"}  # the tool slides disks too; Blender asks in either order
            why = told(NO_LAYOUT if self._spheres else NONE_FOUND)
            self.report({"ERROR"}, f"{told(NO_DISK)}; {why}" if self._by_press else why)
            return {"CANCELLED"}
        self._area, self._region = context.area, window_region(context.area)
        self._slide, self._last = SphereSlide(flat[0].stored.octahedron), None
        self._typed = TypedNumbers(("rotation", "x", "y", "z"))
        self._live = LiveSpheres(context, self._spheres)
        self._show(context)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        part = PRECISE if event.shift else 1.0
        if event.type == "MOUSEMOVE":
            at = uv_at(self._region, event)
            if self._last is None:
                self._slide.grip_at(at)
            elif at != self._last:
                self._slide.drag(at, part)
                self._show(context)
            self._last = at
        elif event.type in {"WHEELUPMOUSE", "WHEELDOWNMOUSE"} and not event.ctrl:
            step = STEP if event.type == "WHEELUPMOUSE" else -STEP
            self._slide.magnify(uv_at(self._region, event), step * part)
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
        layout.prop(self, "toward")
        layout.prop(self, "rotation")

    def _show(self, context):
        """Write the present state, and tell it."""
        self._live.show(self._slide.moebius)
        toward, _ = self._slide.moebius.toward_and_rotation()
        number = self._typed.shown
        text = shown(
            "Rotation {rotation}°   X {x}   Y {y}   Z {z}",
            rotation=number("rotation", self._slide.degrees, 1),
            **{name: number(name, part) for name, part in zip("xyz", toward.tolist(), strict=True)},
        )
        self._area.header_text_set(f"{shown('Conformal Sphere Slide')}   {text}")
        context.workspace.status_text_set(f"{text}      {shown(HELP)}")
        redraw(context, "IMAGE_EDITOR")

    def _finish(self, context):
        toward, rotation = self._slide.moebius.toward_and_rotation()
        self.toward = toward.tolist()
        self.rotation = Matrix(rotation.tolist()).to_euler()
        self._live.keep()
        self._tell(self._spheres)
        self._end(context)
        return {"FINISHED"}

    def _tell(self, spheres):
        self.report({"INFO"}, counted(len(spheres), "Moved {count} sphere", "Moved {count} spheres"))

    def _end(self, context):
        self._live = None
        self._area.header_text_set(None)
        if context.workspace is not None:
            context.workspace.status_text_set(None)
        redraw(context, "IMAGE_EDITOR")
