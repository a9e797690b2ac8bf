"""The operators: thin, over unwrap_objects and the mesh files' reading and writing."""

from dataclasses import replace

import bpy

from . import last_result
from .background import RUNNING, InBackground
from .choices import SHAPES, UNWRAPS
from .edit_mode import follows_uv_selection, target_objects
from .libraries import missing_library
from .options_layout import draw_options
from .properties import Options, UnwrapProperties
from .words import counted, on_button, shown, told
from .worker import BACKEND, under_way

MANY_FACES = 50_000  # from here on the window gets a thread and a progress text


def refusal(context: bpy.types.Context) -> str:
    """Why there is nothing to unwrap, empty where there is something."""
    if under_way():
        return told(RUNNING)
    if context.mode not in {"OBJECT", "EDIT_MESH"}:
        return told("Go to Object Mode or to Edit Mode of a mesh")
    if context.mode == "OBJECT" and not any(ob.type == "MESH" for ob in context.selected_editable_objects):
        return told("Select a mesh object")
    return missing_library()


class UV_OT_conformal_unwrap(UnwrapProperties, InBackground, bpy.types.Operator):
    """Islands of the selected faces mapped, angles kept"""

    bl_idname = "uv.conformal_unwrap"
    bl_label = "Conformal Unwrap"
    bl_description = (
        "Unwrap each island of the selected faces, keeping angles.\n"
        "Mark seams first; in Object Mode a mesh without selected faces is unwrapped as a whole"
    )
    bl_options = {"REGISTER", "UNDO", "PRESET"}

    _solved = None  # what a thread has left in KEPT

    @classmethod
    def poll(cls, context):
        why = refusal(context)
        if why:
            cls.poll_message_set(why)
        return not why

    @classmethod
    def description(cls, context, properties):
        """The tooltip of a menu entry, each of which has its shape."""
        (what,) = (text for identifier, _, text in SHAPES if identifier == properties.shape)
        return f"{shown('Unwrap each island of the selected faces, keeping angles.')}\n{shown(what)}"

    def invoke(self, context, event):
        """From the window: large meshes are solved in a thread, then written by execute from what it kept."""
        objects = target_objects(context)
        self.only_selected_uvs = follows_uv_selection(context)
        if sum(len(ob.data.polygons) for ob in objects) < MANY_FACES and context.mode == "OBJECT":
            return self.execute(context)
        from .kept_work import KEPT
        from .tasks import gather
        from .unwrap_objects import keys_of, solve

        options = Options.of(self)
        tasks = gather(context, objects, options)
        if sum(int(task.surface.chosen.sum()) for task in tasks if task.surface is not None) < MANY_FACES:
            return self.execute(context)
        work = KEPT.fork()
        self._solved = (work, keys_of(tasks, options))
        return self.begin(context, lambda callback: solve(tasks, options, work, callback=callback, backend=BACKEND))

    def finished(self, context):
        """Hand the thread's work over and write."""
        from .kept_work import KEPT

        KEPT.adopt(self._solved[0])
        return self.execute(context)

    def cancel(self, context):
        from .kept_work import KEPT

        KEPT.keep_only(set())  # what the thread shares may be half-made
        super().cancel(context)

    def execute(self, context):
        from conformal_uv import OptionError

        from .unwrap_objects import ChangedMeanwhileError, unwrap_objects

        attended = self.options.is_invoke or self.options.is_repeat  # not called by a script
        if not attended:
            self.only_selected_uvs = follows_uv_selection(context)
        expected, self._solved = (self._solved or (None, None))[1], None
        try:
            with last_result.own_change():
                result = unwrap_objects(context, target_objects(context), Options.of(self), expected=expected)
        except OptionError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        except ChangedMeanwhileError:
            self.report({"WARNING"}, told("The mesh or its selection was changed meanwhile; nothing was written"))
            return {"CANCELLED"}
        last_result.keep(replace(result, seconds=result.seconds + self._seconds), attended)
        self._seconds = 0.0
        if not (result.unwrapped or result.left or (attended and result.tried)):  # the redo panel offers what may help
            self.report({"ERROR"}, result.message)
            return {"CANCELLED"}
        for remark in result.remarks:
            self.report({"INFO"}, remark)
        self.report({"INFO"} if result.complete else {"WARNING"}, result.message)  # the last one stays in sight
        return {"FINISHED"}

    def draw(self, context):
        draw_options(self.layout, self)


class UV_OT_conformal_unwrap_options(bpy.types.Operator):
    """The options of the next unwrap in a dialog"""

    bl_idname = "uv.conformal_unwrap_options"
    bl_label = "Conformal Unwrap with Options"
    bl_description = (
        "Choose shape, presets and all other options, then unwrap.\n"
        "The options are those of the sidebar, and stay for the next time"
    )
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, context):
        why = refusal(context)
        if why:
            cls.poll_message_set(why)
        return not why

    def invoke(self, context, event):
        return context.window_manager.invoke_props_dialog(self, width=360, confirm_text=on_button("Unwrap"))

    def draw(self, context):
        from .presets import UV_PT_conformal_presets

        UV_PT_conformal_presets.draw_menu(self.layout)
        draw_options(self.layout, chosen_options(context))

    def execute(self, context):
        chosen = chosen_options(context)
        return bpy.ops.uv.conformal_unwrap("INVOKE_DEFAULT", True, **Options.of(chosen).as_arguments())


def chosen_options(context):
    """The options of the next unwrap from the window: as the last one had them, and as panels change them."""
    return context.window_manager.operator_properties_last(UV_OT_conformal_unwrap.bl_idname)


class _Selects:
    """What operators have in common that select faces."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        why = told("Go to Edit Mode") if context.mode != "EDIT_MESH" else missing_library()
        if why:
            cls.poll_message_set(why)
        return not why

    def select(self, context, faces_of):
        """Select the faces that the function finds in a mesh; how many there are."""
        from .face_selection import select_faces

        with last_result.own_change():
            # Before: among vertices, Edit Mode would take in every face whose corners are selected.
            context.tool_settings.mesh_select_mode = (False, False, True)
            return select_faces(context, faces_of)


class UV_OT_conformal_select_folded(_Selects, bpy.types.Operator):
    """Faces whose UVs are inverted or have no area"""

    bl_idname = "uv.conformal_select_folded"
    bl_label = "Select Flipped or Collapsed"
    bl_description = (
        "Select visible faces whose UVs are inverted or have no area, in the active UV map.\n"
        "Textures show mirrored or smeared there"
    )

    def execute(self, context):
        from .folded import folded_faces

        found = self.select(context, folded_faces)
        self.report(
            {"INFO"}, counted(found, "{count} face is flipped or collapsed", "{count} faces are flipped or collapsed")
        )
        return {"FINISHED"}


class UV_OT_conformal_select_worst(_Selects, bpy.types.Operator):
    """Faces of the largest angle errors"""

    bl_idname = "uv.conformal_select_worst"
    bl_label = "Select Most Distorted"
    bl_description = (
        "Select visible faces whose angles differ most from those in the active UV map.\n"
        "Seams across them, or another shape, help most"
    )

    by: bpy.props.EnumProperty(
        name="By",
        description="Which faces are selected.\nShare to see the worst, Angle Error to see all that are bad",
        items=(
            ("SHARE", "Share", "As many faces of each mesh as the share says, the worst ones"),
            ("ERROR", "Angle Error", "All faces of which a corner is off by more than the angle"),
        ),
        default="SHARE",
    )
    share: bpy.props.FloatProperty(
        name="Share",
        description="Share of the visible faces of each mesh that is selected.\nThe worst ones",
        subtype="PERCENTAGE",
        min=0.0,
        max=100.0,
        default=5.0,
    )
    error: bpy.props.FloatProperty(
        name="Angle Error",
        description="The least angle by which a corner of a selected face is off.\n"
        "For faces that are bad, however many",
        subtype="ANGLE",
        min=0.0,
        max=3.15,
        default=0.3490658503988659,  # 20 degrees
    )

    def execute(self, context):
        from .worst import worst_faces

        found = self.select(context, lambda mesh: worst_faces(mesh, self.by, self.share, self.error))
        self.report({"INFO"}, counted(found, "{count} face is selected", "{count} faces are selected"))
        return {"FINISHED"}

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "by")
        layout.prop(self, "share" if self.by == "SHARE" else "error")


def draw_unwraps(layout):
    """The unwrap in each of its shapes, as menus have it."""
    layout.operator_context = "INVOKE_DEFAULT"
    for shape, text in UNWRAPS:
        layout.operator(UV_OT_conformal_unwrap.bl_idname, text=text).shape = shape


CLASSES = (
    UV_OT_conformal_unwrap,
    UV_OT_conformal_unwrap_options,
    UV_OT_conformal_select_folded,
    UV_OT_conformal_select_worst,
)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
