"""Islands packed by Blender's own packer, on meshes made for it: nothing of the user's is selected or hidden."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import bpy
import numpy as np
from numpy.typing import NDArray

from .edit_mode import select_only
from .mesh_io import DEFAULT_LAYER, MeshArrays, new_mesh, read_uv
from .properties import Options
from .tasks import Task

FILLED = 0.8  # of a cell's side by its disk, before packing


def pack_with_blender(context: bpy.types.Context, tasks: list[Task], options: Options) -> list[NDArray[np.float32]]:
    """UVs (k, 2) of every task's corners, the islands of all of them in one unit square at their relative sizes.

    In Object Mode. Rotation and shape of the disks are kept.
    """
    cells = int(np.ceil(np.sqrt(sum(len(task.solved.charts) for task in tasks))))
    unit = max(_extent(task) for task in tasks)
    first, made = 0, []
    for task in tasks:
        uv = _side_by_side(task, first, cells)
        first += len(task.solved.charts)
        made.append(new_mesh(_in_units(task, unit), task.solved.mapped, uv))
    try:
        _pack(context, made, options.margin)
        return [_read_back(task, mesh) for task, mesh in zip(tasks, made, strict=True)]
    finally:
        bpy.data.batch_remove(made)


def _extent(task: Task) -> float:
    """The largest coordinate of what was mapped."""
    used = task.surface.arrays.corners[np.repeat(task.solved.mapped, np.diff(task.surface.arrays.starts))]
    return float(np.abs(task.surface.arrays.V[used]).max())


def _in_units(task: Task, unit: float) -> MeshArrays:
    """The mesh with the largest coordinate of all brought to 1: Blender's packer crashes where areas overflow."""
    arrays = task.surface.arrays
    V = arrays.V.astype(np.float64)
    V[~np.isfinite(V)] = 0.0
    return replace(arrays, V=(V / (unit or 1.0)).astype(np.float32))


def _side_by_side(task: Task, first: int, cells: int) -> NDArray[np.float32]:
    """Each unit disk in a cell of the square, so that no two islands share a UV and merge into one."""
    sizes = np.diff(task.surface.arrays.starts)
    number = first + np.repeat(task.solved.chart_of_face, sizes)
    cell = np.column_stack((number % cells, number // cells))
    return ((cell + 0.5 + 0.5 * FILLED * task.solved.uv) / cells).astype(np.float32)


def _read_back(task: Task, mesh: bpy.types.Mesh) -> NDArray[np.float32]:
    sizes = np.diff(task.surface.arrays.starts)
    uv = np.zeros((len(task.surface.arrays.corners), 2), dtype=np.float32)
    uv[np.repeat(task.solved.mapped, sizes)] = read_uv(mesh, DEFAULT_LAYER)
    return uv


def _pack(context: bpy.types.Context, meshes: list[bpy.types.Mesh], margin: float) -> None:
    with _edited(context, meshes):
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.uv.select_all(action="SELECT")
        bpy.ops.uv.average_islands_scale()
        bpy.ops.uv.pack_islands(
            rotate=False, scale=True, margin_method="FRACTION", margin=margin, shape_method="CONVEX"
        )


@contextmanager
def _edited(context: bpy.types.Context, meshes: list[bpy.types.Mesh]) -> Iterator[None]:
    """Objects of these meshes in Edit Mode within the block; what was selected and active is so again afterwards."""
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
        yield
        bpy.ops.object.mode_set(mode="OBJECT")
    finally:
        if context.mode == "EDIT_MESH":
            bpy.ops.object.mode_set(mode="OBJECT")
        bpy.data.batch_remove(made)
        select_only(context, selected, active)
        settings.use_uv_select_sync = sync
