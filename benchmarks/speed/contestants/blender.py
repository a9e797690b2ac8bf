"""Blender: its *Unwrap* of a mesh without seams, or our add-on's, the UVs read back (single precision)."""

from __future__ import annotations

import bpy
import numpy as np

from .outcome import Arrays, Outcome, Stage


def run(arrays: Arrays, stage: Stage, *, ours: bool = False, **options: str) -> Outcome:
    """An object of Blender's from the arrays, the operator in Edit Mode, and its coordinates read back."""
    V, F = arrays["V"], arrays["F"]
    stage("copying")
    if ours and not hasattr(bpy.types, "UV_OT_conformal_unwrap"):
        import blender_addon

        blender_addon.register()
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    mesh = bpy.data.meshes.new("surface")
    mesh.vertices.add(len(V))
    mesh.vertices.foreach_set("co", V.astype(np.float32).reshape(-1))
    mesh.loops.add(F.size)
    mesh.loops.foreach_set("vertex_index", F.astype(np.int32).reshape(-1))
    mesh.polygons.add(len(F))
    mesh.polygons.foreach_set("loop_start", np.arange(0, F.size, F.shape[1], dtype=np.int32))
    mesh.update(calc_edges=True)
    mesh.uv_layers.new(name="UVMap")
    surface = bpy.data.objects.new("surface", mesh)
    bpy.context.scene.collection.objects.link(surface)
    bpy.context.view_layer.objects.active = surface
    surface.select_set(True)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    stage("unwrap")
    unwrap = bpy.ops.uv.conformal_unwrap if ours else bpy.ops.uv.unwrap
    unwrap(**options)
    stage("copying")
    bpy.ops.object.mode_set(mode="OBJECT")
    corner = np.empty(F.size, dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", corner)
    found = np.empty(2 * F.size, dtype=np.float32)
    mesh.uv_layers.active.uv.foreach_get("vector", found)
    if not found.any():
        raise RuntimeError("nothing was unwrapped")
    uv = np.empty((len(V), 2))
    uv[corner] = found.reshape(-1, 2)
    return Outcome(2.0 * uv - 1.0 if ours else uv)  # ours fills the square [0, 1]^2
