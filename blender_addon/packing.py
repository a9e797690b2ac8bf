"""Islands packed into one square: by conformal_uv, or by Blender on meshes made for it, so that nothing of the user's
is selected or hidden.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import bpy
import numpy as np
from numpy.typing import NDArray

from conformal_uv import MissingDependencyError, pack_together

from .edit_mode import select_only, settled_mesh
from .mesh_io import DEFAULT_LAYER, MeshArrays, new_mesh, read_uv
from .properties import Options
from .tasks import Task

OUTLINES = ("CONVEX", "AABB")  # how Blender sees islands; after Esc was pressed, 4.3 still packs by the second
FILLED = 0.8  # of a cell's side by its island, before packing


def placed(
    context: bpy.types.Context, tasks: list[Task], options: Options, remarks: list[str]
) -> list[NDArray[np.floating]]:
    """UVs (k, 2) of every task's corners, in Object Mode; the islands of all of them in one unit square.

    What packs is what the options ask for, and the other where that can not: rectangle-packer may be
    missing, and Blender's packer does nothing after Esc was pressed somewhere (4.3). `remarks` is told.
    """
    if options.place == "PACK":
        packed = pack_with_blender(context, tasks, options)
        if packed is not None:
            return packed
        remarks.append("Blender's packer left the islands as they were; conformal_uv packed them")
    try:
        return _packed_by_us(tasks, options.margin)
    except MissingDependencyError:
        packed = None if options.place == "PACK" else pack_with_blender(context, tasks, options)
        remarks.append(
            "rectangle-packer is not installed; "
            + ("Blender packed the islands" if packed is not None else "the islands lie in a grid")
        )
        return packed if packed is not None else _in_cells(tasks)


def _packed_by_us(tasks: list[Task], margin: float) -> list[NDArray[np.floating]]:
    """The same by conformal_uv; one island alone fills the square."""
    if sum(int(task.written.sum()) for task in tasks) == 1:
        return [0.5 + 0.5 * task.solved.uv for task in tasks]
    margin = round(margin, 6)  # as it was typed; the property is of single precision
    return pack_together([task.solved for task in tasks], [task.written for task in tasks], margin)


def pack_with_blender(
    context: bpy.types.Context, tasks: list[Task], options: Options
) -> list[NDArray[np.floating]] | None:
    """The same by Blender, the islands at their relative sizes; None where its packer does nothing.

    Islands are neither turned nor stretched.
    """
    unit = max(_extent(task) for task in tasks)
    made = [
        new_mesh(_in_units(task, unit), task.mapped, uv.astype(np.float32))
        for task, uv in zip(tasks, _in_cells(tasks), strict=True)
    ]
    try:
        outlines = OUTLINES if options.shape == "DISK" else ("CONCAVE", *OUTLINES)
        if not _pack(context, made, options.margin, outlines):
            return None
        return [_read_back(task, mesh) for task, mesh in zip(tasks, made, strict=True)]
    finally:
        bpy.data.batch_remove(made)


def _in_cells(tasks: list[Task]) -> list[NDArray[np.floating]]:
    """Each island in a cell of the square: no two islands then share a UV and merge into one."""
    cells = int(np.ceil(np.sqrt(sum(len(task.solved.charts) for task in tasks))))
    first, out = 0, []
    for task in tasks:
        number = first + np.repeat(task.solved.chart_of_face, np.diff(task.surface.arrays.starts))
        cell = np.column_stack((number % cells, number // cells))
        out.append((cell + 0.5 + 0.5 * FILLED * task.solved.uv) / cells)
        first += len(task.solved.charts)
    return out


def _extent(task: Task) -> float:
    """The largest coordinate of what was mapped."""
    used = task.surface.arrays.corners[np.repeat(task.mapped, np.diff(task.surface.arrays.starts))]
    return float(np.abs(task.surface.arrays.V[used]).max())


def _in_units(task: Task, unit: float) -> MeshArrays:
    """The mesh with the largest coordinate of all brought to 1: Blender's packer crashes where areas overflow."""
    arrays = task.surface.arrays
    V = arrays.V.astype(np.float64)
    V[~np.isfinite(V)] = 0.0
    return replace(arrays, V=(V / (unit or 1.0)).astype(np.float32))


def _read_back(task: Task, mesh: bpy.types.Mesh) -> NDArray[np.float32]:
    sizes = np.diff(task.surface.arrays.starts)
    uv = np.zeros((len(task.surface.arrays.corners), 2), dtype=np.float32)
    uv[np.repeat(task.mapped, sizes)] = read_uv(mesh, DEFAULT_LAYER)
    return uv


def _pack(context: bpy.types.Context, meshes: list[bpy.types.Mesh], margin: float, outlines: tuple[str, ...]) -> bool:
    """Run Blender's packer on the first of these outlines that it can pack; whether it moved anything."""
    with _edited(context, meshes) as objects:
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.uv.select_all(action="SELECT")
        bpy.ops.uv.average_islands_scale()
        before = _uvs(objects)
        for shape in outlines:
            bpy.ops.uv.pack_islands(
                rotate=False, scale=True, margin_method="FRACTION", margin=margin, shape_method=shape
            )
            if not np.array_equal(_uvs(objects), before):
                return True
    return False


def _uvs(objects: list[bpy.types.Object]) -> NDArray[np.float32]:
    """UVs of all corners of objects in Edit Mode."""
    found = []
    for ob in objects:
        with settled_mesh(ob) as mesh:
            found.append(read_uv(mesh, DEFAULT_LAYER))
    return np.concatenate(found)


@contextmanager
def _edited(context: bpy.types.Context, meshes: list[bpy.types.Mesh]) -> Iterator[list[bpy.types.Object]]:
    """Objects of these meshes, in Edit Mode within the block; what was selected and active is so again afterwards."""
    objects, settings = context.view_layer.objects, context.scene.tool_settings
    selected, active = set(context.selected_objects), objects.active
    sync, settings.use_uv_select_sync = settings.use_uv_select_sync, True
    made = [bpy.data.objects.new(mesh.name, mesh) for mesh in meshes]
    try:
        for ob in made:
            context.scene.collection.objects.link(ob)
        context.view_layer.update()  # new objects can not be selected before
        select_only(context, set(made), made[0])
        bpy.ops.object.mode_set(mode="EDIT")
        yield made
        bpy.ops.object.mode_set(mode="OBJECT")
    finally:
        if context.mode == "EDIT_MESH":
            bpy.ops.object.mode_set(mode="OBJECT")
        bpy.data.batch_remove(made)
        select_only(context, selected, active)
        settings.use_uv_select_sync = sync
