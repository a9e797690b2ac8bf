"""The operator Conformal Sphere Map: a shape key that turns a closed mesh into its conformal sphere."""

from contextlib import nullcontext

import bpy

from . import last_result
from .background import RUNNING, InBackground
from .libraries import missing_library
from .words import counted, told
from .worker import BACKEND, under_way

MANY_FACES = 10_000  # from here on the window gets a thread and a progress text


class OBJECT_OT_conformal_sphere(InBackground, bpy.types.Operator):
    """A shape key that turns a closed mesh into its conformal sphere"""

    bl_idname = "object.conformal_sphere"
    bl_label = "Conformal Sphere Map"
    bl_description = (
        "Add a shape key that turns each selected closed mesh into a sphere, keeping angles.\n"
        "For closed meshes without handles; UVs are written on request"
    )
    bl_options = {"REGISTER", "UNDO", "PRESET"}

    method: bpy.props.EnumProperty(
        name="Method",
        description="How the map is computed.\nAutomatic unless time or a comparison matters",
        items=(
            ("AUTO", "Automatic", "The method that keeps the angles best"),
            ("LINEAR", "Linear", "One factorization; the fastest"),
            ("SCHWARZ", "Schwarz", "Two overlapping parts in turn; for large scans and long limbs"),
            ("NEWTON", "Newton", "The least conformal energy; for coarse meshes"),
        ),
        default="AUTO",
    )
    uv: bpy.props.EnumProperty(
        name="UVs",
        description="Layout that is written into the active UV map.\nNone leaves the UVs as they are",
        items=(
            ("NONE", "None", "Leave the UVs as they are"),
            ("EQUIRECTANGULAR", "Equirectangular", "Longitude and latitude; faces across the seam go on beyond 1"),
            ("OCTAHEDRAL", "Octahedral", "The octahedron unfolded to a square"),
        ),
        default="NONE",
    )

    _expected = None  # what a thread has solved

    @classmethod
    def poll(cls, context):
        why = told(RUNNING) if under_way() else missing_library()
        if not why and context.mode != "OBJECT":
            why = told("Go to Object Mode")
        if not why and not any(ob.type == "MESH" for ob in context.selected_editable_objects):
            why = told("Select a mesh object")
        if why:
            cls.poll_message_set(why)
        return not why

    def invoke(self, context, event):
        """From the window: large meshes are solved in a thread, then written by execute from what it kept."""
        from .spheres import SpherePart, solve

        objects = self._objects(context)
        if sum(len(ob.data.polygons) for ob in objects) < MANY_FACES:
            return self.execute(context)
        method, parts = self.method.lower(), [SpherePart.of(ob) for ob in objects]
        self._expected = {part.digest for part in parts}
        return self.begin(context, lambda callback: solve(parts, method, callback=callback, backend=BACKEND))

    def finished(self, context):
        return self.execute(context)

    def execute(self, context):
        from .spheres import SpherePart, solve, write

        objects = self._objects(context)
        parts = [SpherePart.of(ob) for ob in objects] if context.mode == "OBJECT" else []
        expected, self._expected = self._expected, None
        if expected is not None and {part.digest for part in parts} != expected:
            self.report({"WARNING"}, told("The mesh or its selection was changed meanwhile; nothing was written"))
            return {"CANCELLED"}
        solve(parts, self.method.lower())
        with last_result.own_change() if self.uv == "NONE" else nullcontext():  # else UVs are others now
            reasons = [write(ob, part, self.uv) for ob, part in zip(objects, parts, strict=True)]
        failures = [f"{ob.name}: {why}" for ob, why in zip(objects, reasons, strict=True) if why]
        done = len(objects) - len(failures)
        message = "; ".join(
            [
                counted(
                    len(objects),
                    "Mapped {done} of {count} mesh to a sphere",
                    "Mapped {done} of {count} meshes to spheres",
                    done=done,
                ),
                *failures,
            ]
        )
        if not done:
            self.report({"ERROR"}, message)
            return {"CANCELLED"}
        for ob, part in zip(objects, parts, strict=True):
            if part.uneven:
                self.report({"INFO"}, f"{ob.name}: {told(part.uneven)}")
        self.report({"WARNING"} if failures else {"INFO"}, message)
        return {"FINISHED"}

    def _objects(self, context):
        """Selected mesh objects, of several with one mesh the last."""
        return list({ob.data: ob for ob in context.selected_editable_objects if ob.type == "MESH"}.values())


def register():
    bpy.utils.register_class(OBJECT_OT_conformal_sphere)


def unregister():
    bpy.utils.unregister_class(OBJECT_OT_conformal_sphere)
