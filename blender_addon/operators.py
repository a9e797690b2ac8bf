"""The operators: thin, over unwrap_objects and the mesh files' reading and writing."""

from dataclasses import replace

import bpy

from . import last_result
from .choices import SHAPES
from .edit_mode import follows_uv_selection, target_objects
from .libraries import missing_library
from .properties import SHOWN, SHOWN_FOR_ALL, Options, UnwrapProperties

MANY_FACES = 50_000  # from here on the window gets a thread and a progress text


def refusal(context: bpy.types.Context) -> str:
    """Why there is nothing to unwrap, empty where there is something."""
    if context.mode not in {"OBJECT", "EDIT_MESH"}:
        return "Go to Object Mode or to Edit Mode of a mesh"
    if context.mode == "OBJECT" and not any(ob.type == "MESH" for ob in context.selected_editable_objects):
        return "Select a mesh object"
    return missing_library()


class UV_OT_conformal_unwrap(UnwrapProperties, bpy.types.Operator):
    """Map each island of the selected faces to a disk, its own outline or a rectangle, keeping angles"""

    bl_idname = "uv.conformal_unwrap"
    bl_label = "Conformal Unwrap"
    bl_options = {"REGISTER", "UNDO"}

    _worker = None
    _seconds = 0.0  # that a thread has spent already

    @classmethod
    def poll(cls, context):
        why = refusal(context)
        if why:
            cls.poll_message_set(why)
        return not why

    @classmethod
    def description(cls, context, properties):
        """The tooltip of a menu entry, each of which has its shape."""
        (told,) = (text for identifier, _, text in SHAPES if identifier == properties.shape)
        return f"Unwrap each island of the selected faces, keeping angles. {told}"

    def invoke(self, context, event):
        """From the window: large meshes are solved in a thread, then written by execute from what it kept."""
        objects = target_objects(context)
        self.only_selected_uvs = follows_uv_selection(context)
        if sum(len(ob.data.polygons) for ob in objects) < MANY_FACES and context.mode == "OBJECT":
            return self.execute(context)
        from .worker import Worker

        worker = Worker(context, objects, Options.of(self))
        if worker.faces < MANY_FACES:
            return self.execute(context)
        self._worker = worker
        worker.start(context)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC" and event.value == "PRESS":
            self._worker.cancel(context)
            self.report({"INFO"}, "Conformal Unwrap cancelled; nothing was changed")
            return {"CANCELLED"}
        if event.type == "TIMER":
            if self._worker.running:
                self._worker.show(context)
            else:
                self._seconds = self._worker.finish(context)
                return self.execute(context)
        return {"RUNNING_MODAL"}

    def cancel(self, context):
        """Blender closes the window or loads another file."""
        if self._worker is not None:
            self._worker.cancel(context)

    def execute(self, context):
        from conformal_uv import OptionError

        from .unwrap_objects import unwrap_objects

        attended = self.options.is_invoke or self.options.is_repeat  # not called by a script
        if not attended:
            self.only_selected_uvs = follows_uv_selection(context)
        try:
            result = unwrap_objects(context, target_objects(context), Options.of(self))
        except OptionError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        last_result.keep(replace(result, seconds=result.seconds + self._seconds))
        self._seconds = 0.0
        if not (result.unwrapped or result.left or (attended and result.tried)):  # the redo panel offers what may help
            self.report({"ERROR"}, result.message)
            return {"CANCELLED"}
        for remark in result.remarks:
            self.report({"INFO"}, remark)
        self.report({"INFO"} if result.complete else {"WARNING"}, result.message)  # the last one stays in sight
        return {"FINISHED"}

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        for names in (("shape", *SHOWN[self.shape]), *SHOWN_FOR_ALL):
            column = layout.column()
            for name in names:
                if name != "image_size" or self.margin_method == "PIXELS":
                    column.prop(self, name)
            layout.separator(factor=0.5)


class UV_OT_conformal_select_folded(bpy.types.Operator):
    """Select visible faces whose UVs are inverted or have no area, in the active UV map"""

    bl_idname = "uv.conformal_select_folded"
    bl_label = "Select Flipped or Collapsed"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        why = "Go to Edit Mode" if context.mode != "EDIT_MESH" else missing_library()
        if why:
            cls.poll_message_set(why)
        return not why

    def execute(self, context):
        from .folded import select_folded

        found = select_folded(context)
        context.tool_settings.mesh_select_mode = (False, False, True)
        self.report({"INFO"}, f"{found} faces are flipped or collapsed")
        return {"FINISHED"}


CLASSES = (UV_OT_conformal_unwrap, UV_OT_conformal_select_folded)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
