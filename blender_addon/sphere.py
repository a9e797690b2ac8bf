"""The operator Conformal Sphere Map: a shape key that turns a closed mesh into its conformal sphere."""

import bpy

from .libraries import missing_library
from .mesh_io import has_room, read_mesh, uv_layer_name, write_shape_key, write_uv

SHAPE_KEY = "Conformal Sphere"


class OBJECT_OT_conformal_sphere(bpy.types.Operator):
    """Add a shape key that turns each selected closed mesh into a sphere, keeping angles"""

    bl_idname = "object.conformal_sphere"
    bl_label = "Conformal Sphere Map"
    bl_options = {"REGISTER", "UNDO"}

    method: bpy.props.EnumProperty(
        name="Method",
        items=(
            ("AUTO", "Automatic", "The method that keeps the angles best"),
            ("LINEAR", "Linear", "One factorization; the fastest"),
            ("SCHWARZ", "Schwarz", "Two charts in turn; for large scans and long limbs"),
            ("NEWTON", "Newton", "The least conformal energy; for coarse meshes"),
        ),
        default="AUTO",
    )
    uv: bpy.props.EnumProperty(
        name="UVs",
        items=(
            ("NONE", "None", "Leave the UVs as they are"),
            ("EQUIRECTANGULAR", "Equirectangular", "Longitude and latitude; faces across the seam go on beyond 1"),
            ("OCTAHEDRAL", "Octahedral", "The octahedron unfolded to a square"),
        ),
        default="NONE",
    )

    @classmethod
    def poll(cls, context):
        why = "Go to Object Mode" if context.mode != "OBJECT" else missing_library()
        if not why and not any(ob.type == "MESH" for ob in context.selected_editable_objects):
            why = "Select a mesh object"
        if why:
            cls.poll_message_set(why)
        return not why

    def execute(self, context):
        from conformal_uv import ConformalUVError

        objects = {ob.data: ob for ob in context.selected_editable_objects if ob.type == "MESH"}
        failures = []
        for ob in objects.values():
            try:
                self._map(ob)
            except ConformalUVError as error:
                failures.append(f"{ob.name}: {error.told(lambda remedy: '')}")
        done = len(objects) - len(failures)
        message = "; ".join([f"Mapped {done} of {len(objects)} meshes to spheres", *failures])
        if not done:
            self.report({"ERROR"}, message)
            return {"CANCELLED"}
        self.report({"WARNING"} if failures else {"INFO"}, message)
        return {"FINISHED"}

    def _map(self, ob):
        """Solve, then write; a mesh that can not be mapped is left as it was."""
        import numpy as np

        from conformal_uv import (
            MeshError,
            OptionError,
            PolygonMesh,
            equirectangular,
            octahedral,
            sphere_map,
            triangulate,
        )

        layer = uv_layer_name(ob.data, "")
        if self.uv != "NONE" and not has_room(ob.data, layer):
            raise OptionError("it has eight UV maps already; remove one.")
        arrays = read_mesh(ob.data, layer)
        V = arrays.V.astype(np.float64)
        mesh = PolygonMesh(V, arrays.corners.astype(np.int64), arrays.starts.astype(np.int64))
        triangles, polygon, _ = triangulate(mesh)
        used, F = np.unique(triangles, return_inverse=True)
        try:
            result = sphere_map(V[used], F.reshape(-1, 3), method=self.method.lower(), rotation="surface")
        except MeshError as error:
            raise error.renumbered(polygon, used) from error
        positions, xyz = V.copy(), np.zeros_like(V)
        positions[used], xyz[used] = result.around_surface, result.xyz
        write_shape_key(ob, SHAPE_KEY, positions)
        if self.uv != "NONE":
            layout = {"EQUIRECTANGULAR": equirectangular, "OCTAHEDRAL": octahedral}[self.uv]
            write_uv(ob.data, layer, layout(xyz, mesh), np.ones(len(mesh.corners), dtype=bool))


def register():
    bpy.utils.register_class(OBJECT_OT_conformal_sphere)


def unregister():
    bpy.utils.unregister_class(OBJECT_OT_conformal_sphere)
