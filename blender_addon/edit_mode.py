"""Edit Mode left for a moment and entered again as it was; meshes in Edit Mode seen as arrays see them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bmesh
import bpy


@contextmanager
def object_mode(context: bpy.types.Context) -> Iterator[None]:
    """Within the block every object is in Object Mode; the same objects are edited and selected afterwards."""
    if context.mode != "EDIT_MESH":
        yield
        return
    objects = context.view_layer.objects
    edited, selected, active = set(context.objects_in_mode), set(context.selected_objects), objects.active
    bpy.ops.object.mode_set(mode="OBJECT")
    try:
        yield
    finally:
        select_only(context, edited, active)
        bpy.ops.object.mode_set(mode="EDIT")
        for ob in selected | edited:
            ob.select_set(ob in selected)


def select_only(context: bpy.types.Context, chosen: set[bpy.types.Object], active: bpy.types.Object | None) -> None:
    """Select these objects and no others, one of them active; entering Edit Mode takes in all selected ones."""
    for ob in set(context.selected_objects) - chosen:
        ob.select_set(False)
    for ob in chosen:
        ob.select_set(True)
    context.view_layer.objects.active = active


@contextmanager
def settled_mesh(ob: bpy.types.Object, in_file: bool = False) -> Iterator[bpy.types.Mesh]:
    """The object's mesh with all its attributes, as a copy that shares their arrays where it is in Edit Mode.

    Parameters
    ----------
    in_file : bool
        Whether the copy is one of the file's meshes. For one that comes and goes Blender draws all views again, and
        tells at once of what an undo has changed. Else an object has one copy at a time.
    """
    if ob.mode != "EDIT":
        yield ob.data
        return
    ob.update_from_editmode()
    copy = ob.data.copy() if in_file else ob.to_mesh()
    try:
        yield copy
    finally:
        if in_file:
            bpy.data.meshes.remove(copy)
        else:
            ob.to_mesh_clear()


def follows_uv_selection(context: bpy.types.Context) -> bool:
    """Whether Blender's own unwrap would take selected UVs here, and not all of the selected faces."""
    if context.mode != "EDIT_MESH" or getattr(context.space_data, "type", "") != "IMAGE_EDITOR":
        return False
    if not context.scene.tool_settings.use_uv_select_sync:
        return True
    edited = (bmesh.from_edit_mesh(ob.data) for ob in context.objects_in_mode_unique_data)
    return any(getattr(mesh, "uv_select_sync_valid", False) for mesh in edited)  # 5.0: UVs selected apart, in sync


def active_vertex(ob: bpy.types.Object) -> int | None:
    """Index of the vertex that was selected last, None where that is no vertex."""
    if ob.mode == "EDIT":
        return _last_selected(bmesh.from_edit_mesh(ob.data))
    copy = bmesh.new()
    try:
        copy.from_mesh(ob.data)
        return _last_selected(copy)
    finally:
        copy.free()


def _last_selected(edited: bmesh.types.BMesh) -> int | None:
    active = edited.select_history.active
    if not isinstance(active, bmesh.types.BMVert):
        return None
    edited.verts.index_update()
    return active.index


def target_objects(context: bpy.types.Context) -> list[bpy.types.Object]:
    """Mesh objects to unwrap: those in Edit Mode, or those selected; of several with one mesh the first."""
    if context.mode == "EDIT_MESH":
        return list(context.objects_in_mode_unique_data)
    unique: dict[bpy.types.Mesh, bpy.types.Object] = {}
    for ob in context.selected_editable_objects:
        if ob.type == "MESH":
            unique.setdefault(ob.data, ob)
    return list(unique.values())
