"""The operator Conformal Flatten: the mesh laid flat by its active UV map, as a new object or a shape key."""

import bpy
from mathutils import Vector

from . import last_result
from .libraries import missing_library
from .words import counted, told

SHAPE_KEY = "Conformal Flat"


class OBJECT_OT_conformal_flatten(bpy.types.Operator):
    """Meshes laid flat by their active UV maps"""

    bl_idname = "object.conformal_flatten"
    bl_label = "Conformal Flatten"
    bl_description = (
        "Lay each selected mesh flat as its active UV map does.\nFor patterns, cutting, prints and Geometry Nodes"
    )
    bl_options = {"REGISTER", "UNDO", "PRESET"}

    result: bpy.props.EnumProperty(
        name="Result",
        description="What is made.\nA shape key needs a map that is torn nowhere",
        items=(
            ("OBJECT", "New Object", "A flat mesh beside the object, torn along its seams"),
            ("SHAPE_KEY", "Shape Key", "Slide between the surface and its flat form; for maps that are torn nowhere"),
        ),
        default="OBJECT",
    )
    size: bpy.props.EnumProperty(
        name="Size",
        description="How large the flat mesh is.\nAs the Surface for patterns of true size",
        items=(
            ("SURFACE", "As the Surface", "Each island has the area of its surface, the object's scale included"),
            ("UV", "As the UVs", "Positions are the UVs"),
        ),
        default="SURFACE",
    )
    gap: bpy.props.FloatProperty(
        name="Gap",
        description="Space between islands.\nWhere they have the size of the surface",
        min=0.0,
        default=0.02,
        unit="LENGTH",
    )

    @classmethod
    def poll(cls, context):
        why = told("Go to Object Mode") if context.mode != "OBJECT" else missing_library()
        if not why and not any(ob.type == "MESH" for ob in context.selected_editable_objects):
            why = told("Select a mesh object")
        if why:
            cls.poll_message_set(why)
        return not why

    def execute(self, context):
        objects = [ob for ob in context.selected_editable_objects if ob.type == "MESH"]
        refusals, made = [], []
        for ob in objects:
            why = self._refusal(ob) or self._flatten(context, ob, made)
            if why:
                refusals.append(f"{ob.name}: {why}")
        done = len(objects) - len(refusals)
        text = counted(
            len(objects), "Flattened {done} of {count} mesh", "Flattened {done} of {count} meshes", done=done
        )
        message = "; ".join([text, *refusals])
        if not done:
            self.report({"ERROR"}, message)
            return {"CANCELLED"}
        if made:
            from .edit_mode import select_only

            context.view_layer.update()  # new objects can not be selected before
            select_only(context, set(made), made[-1])
        self.report({"WARNING"} if refusals else {"INFO"}, message)
        return {"FINISHED"}

    def _refusal(self, ob):
        if not len(ob.data.polygons):
            return told("the mesh has no faces")
        if ob.data.uv_layers.active is None:
            return told("the mesh has no UV map; unwrap it first")
        scale = [abs(factor) for factor in ob.matrix_world.to_scale()]
        if self.result == "OBJECT" and self.size == "SURFACE" and max(scale) > 1.001 * min(scale):
            return told("its scale is not uniform; apply it first")
        return ""

    def _flatten(self, context, ob, made):
        """Make the object or the shape key; why it can not be made."""
        import numpy as np

        from conformal_uv import PolygonMesh, flattened

        from .mesh_reading import read_mesh, read_uv
        from .mesh_writing import flat_mesh, write_shape_key

        mesh, layer = ob.data, ob.data.uv_layers.active.name
        arrays, uv = read_mesh(mesh, layer), read_uv(mesh, layer)
        in_world = self.result == "OBJECT" and self.size == "SURFACE"
        factor = abs(ob.matrix_world.to_scale()[0]) if in_world else 1.0
        V = arrays.V.astype(np.float64)
        polygons = PolygonMesh(factor * V, arrays.corners.astype(np.int64), arrays.starts.astype(np.int64))
        flat = flattened(polygons, uv, true_size=self.size == "SURFACE", margin=self.gap)
        if self.result == "OBJECT":
            made.append(self._new_object(context, ob, flat_mesh(mesh, flat.mesh.V, flat.mesh.corners, flat.vertex)))
            return ""
        if len(flat.torn):
            return counted(
                len(flat.torn),
                "the UV map is torn at {count} vertex; make a new object",
                "the UV map is torn at {count} vertices; make a new object",
            )
        positions = V.copy()
        middle = 0.5 * (flat.mesh.V.min(axis=0) + flat.mesh.V.max(axis=0))
        used = V[flat.vertex]
        positions[flat.vertex] = flat.mesh.V - middle + 0.5 * (used.min(axis=0) + used.max(axis=0))
        with last_result.own_change():
            write_shape_key(ob, SHAPE_KEY, positions)
        return ""

    def _new_object(self, context, ob, mesh):
        flat = bpy.data.objects.new(f"{ob.name} Flat", mesh)
        flat.location = ob.matrix_world.translation
        flat.location.x = self.gap + max((ob.matrix_world @ Vector(corner)).x for corner in ob.bound_box)
        for collection in ob.users_collection or (context.scene.collection,):
            collection.objects.link(flat)
        return flat


def register():
    bpy.utils.register_class(OBJECT_OT_conformal_flatten)


def unregister():
    bpy.utils.unregister_class(OBJECT_OT_conformal_flatten)
