"""The operator Conformal Pack Islands: islands of the active UV maps packed, whatever made them."""

import bpy

from .edit_mode import follows_uv_selection
from .operators import refusal
from .options_layout import means_something
from .properties import PACKING, PackOptions, PackProperties
from .words import told


class UV_OT_conformal_pack(PackProperties, bpy.types.Operator):
    """Islands of the active UV maps packed, whatever made them"""

    bl_idname = "uv.conformal_pack"
    bl_label = "Conformal Pack Islands"
    bl_description = (
        "Pack the islands of all edited or selected objects into the square, by their outlines.\n"
        "Whatever unwrapped them; fills more than boxes do"
    )
    bl_options = {"REGISTER", "UNDO", "PRESET"}

    average_scale: bpy.props.BoolProperty(
        name="Average Scale",
        description="Give islands sizes in the proportion of their surfaces.\nOff: they keep theirs to each other",
        default=False,
    )
    only_selected_uvs: bpy.props.BoolProperty(options={"HIDDEN", "SKIP_SAVE"}, default=False)

    @classmethod
    def poll(cls, context):
        why = refusal(context)
        if why:
            cls.poll_message_set(why)
        return not why

    def invoke(self, context, event):
        self.only_selected_uvs = follows_uv_selection(context)
        return self.execute(context)

    def execute(self, context):
        from conformal_uv import ConformalUVError

        from .packing import pack_objects

        if not (self.options.is_invoke or self.options.is_repeat):
            self.only_selected_uvs = follows_uv_selection(context)
        try:
            faces = pack_objects(
                context,
                PackOptions.of(self),
                average_scale=self.average_scale,
                only_selected=self.only_selected_uvs,
            )
        except ConformalUVError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if not faces:
            self.report({"ERROR"}, told("No visible face with UVs is selected"))
            return {"CANCELLED"}
        return {"FINISHED"}

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        for name in ("average_scale", *PACKING):
            if means_something(name, self):
                layout.prop(self, name)


def register():
    bpy.utils.register_class(UV_OT_conformal_pack)


def unregister():
    bpy.utils.unregister_class(UV_OT_conformal_pack)
