"""The operator Conformal Distortion Overlay: colours on the surface that say how angles and areas are changed.

Two float attributes of faces hold the numbers, for Geometry Nodes, spreadsheets and materials; a colour attribute of
corners shows one of them. The 3D views show it in Solid shading until the overlay is switched off.
"""

import bpy

from . import last_result
from .edit_mode import object_mode, target_objects
from .libraries import missing_library
from .words import told

ANGLE, AREA, COLORS = "conformal_angle_error", "conformal_area_scale", "conformal_distortion"
BEFORE = "conformal_uv_color_before"  # property of the mesh: its active colour attribute

_shading = {}  # what 3D views showed before: by screen and number of the area


class VIEW3D_OT_conformal_overlay(bpy.types.Operator):
    """Changes of angles or areas by the active UV map as colours on the surface"""

    bl_idname = "view3d.conformal_overlay"
    bl_label = "Conformal Distortion Overlay"
    bl_description = (
        "Show how the active UV map changes angles or areas as colours on the surface, or stop showing it.\n"
        "To see where seams are missing; attributes of faces hold the numbers"
    )
    bl_options = {"REGISTER", "UNDO"}

    quantity: bpy.props.EnumProperty(
        name="Show",
        description="What colours stand for.\nNothing removes the overlay",
        items=(
            ("ANGLE", "Angles", "Mean angle error of each face: dark violet is none, yellow the limit and more"),
            ("AREA", "Areas", "Area in the texture for area on the surface: grey is the mean, blue less, red more"),
            ("NONE", "Nothing", "Remove the overlay"),
        ),
        default="ANGLE",
    )
    most_angle: bpy.props.FloatProperty(
        name="Limit",
        description="Angle error in degrees that is yellow.\nMore is yellow too",
        min=0.01,
        soft_max=90.0,
        default=10.0,
    )
    most_area: bpy.props.FloatProperty(
        name="Limit",
        description="Factor to the mean area that is red.\nIts inverse is blue",
        min=1.01,
        default=2.0,
    )

    @classmethod
    def poll(cls, context):
        why = missing_library()
        if context.mode not in {"OBJECT", "EDIT_MESH"}:
            why = told("Go to Object Mode or to Edit Mode of a mesh")
        elif not why and not target_objects(context):
            why = told("Select a mesh object")
        if why:
            cls.poll_message_set(why)
        return not why

    def execute(self, context):
        objects = [ob for ob in target_objects(context) if ob.data.library is None]
        with last_result.own_change(), object_mode(context):
            have_colors = [self._show(ob.data) for ob in objects]
        if self.quantity == "NONE":
            restore_views()
            return {"FINISHED"}
        if not any(have_colors):
            self.report({"ERROR"}, told("No selected mesh has faces and a UV map"))
            return {"CANCELLED"}
        show_in_views(context)
        self.report({"INFO"}, self._legend())
        return {"FINISHED"}

    def _show(self, mesh):
        """Write or remove the attributes of a mesh; whether there is something to show."""
        from .mesh_reading import read_mesh, read_uv
        from .mesh_writing import write_colors, write_face_floats

        layer = mesh.uv_layers.active
        if self.quantity == "NONE":
            remove(mesh)
            return False
        if layer is None or not len(mesh.polygons):
            return False
        from conformal_uv import PolygonMesh, angle_colors, area_colors, polygon_distortion

        arrays = read_mesh(mesh, layer.name)
        polygons = PolygonMesh(arrays.V.astype(float), arrays.corners.astype(int), arrays.starts.astype(int))
        found = polygon_distortion(polygons, read_uv(mesh, layer.name))
        if BEFORE not in mesh:
            active = mesh.color_attributes.active_color
            mesh[BEFORE] = active.name if active is not None else ""
        write_face_floats(mesh, ANGLE, found.angle_error)
        write_face_floats(mesh, AREA, found.area_scale)
        colors = (
            angle_colors(found.angle_error, self.most_angle)
            if self.quantity == "ANGLE"
            else area_colors(found.area_scale, self.most_area)
        )
        write_colors(mesh, COLORS, colors.repeat(polygons.sizes, axis=0))
        return True

    def _legend(self):
        attributes = {"angle": ANGLE, "area": AREA}
        if self.quantity == "ANGLE":
            return told(
                "Yellow stands for {limit:g} degrees and more; numbers are in {angle} and {area}",
                limit=self.most_angle,
                **attributes,
            )
        return told(
            "Red stands for {limit:g} times the mean area and more; numbers are in {angle} and {area}",
            limit=self.most_area,
            **attributes,
        )

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "quantity")
        if self.quantity != "NONE":
            layout.prop(self, "most_angle" if self.quantity == "ANGLE" else "most_area")


def remove(mesh):
    """Take the overlay's attributes off a mesh, its active colour attribute being what it was."""
    for name in (ANGLE, AREA, COLORS):
        if name in mesh.attributes:
            mesh.attributes.remove(mesh.attributes[name])
    before = mesh.pop(BEFORE, "") if BEFORE in mesh else ""
    if before in mesh.color_attributes:
        mesh.color_attributes.active_color = mesh.color_attributes[before]


def show_in_views(context):
    """Let 3D views in Solid shading show colour attributes, and remember what they showed."""
    for screen in {window.screen for window in context.window_manager.windows}:
        for number, area in enumerate(screen.areas):
            if area.type == "VIEW_3D":
                shading = area.spaces.active.shading
                _shading.setdefault((screen.name, number), shading.color_type)
                shading.color_type = "VERTEX"


def restore_views():
    """Let 3D views show what they showed before."""
    for (name, number), before in _shading.items():
        screen = bpy.data.screens.get(name)
        area = screen.areas[number] if screen is not None and number < len(screen.areas) else None
        if area is not None and area.type == "VIEW_3D" and area.spaces.active.shading.color_type == "VERTEX":
            area.spaces.active.shading.color_type = before
    _shading.clear()


def register():
    bpy.utils.register_class(VIEW3D_OT_conformal_overlay)


def unregister():
    bpy.utils.unregister_class(VIEW3D_OT_conformal_overlay)
    _shading.clear()
