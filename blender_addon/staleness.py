"""The last result is called stale as soon as something else changes its meshes or UVs, and undo may bring it back."""

from __future__ import annotations

import bpy

from . import last_result

SECONDS = 0.3  # from the last change until meshes are looked at


@bpy.app.handlers.persistent
def changed(scene, depsgraph):
    """Something was changed: was it a mesh of the result?"""
    result = last_result.last()
    if result is None or last_result.changing() or last_result.stale():
        return
    meshes = {ob.mesh for ob in result.objects}
    for update in depsgraph.updates:
        if update.is_updated_geometry and isinstance(update.id, bpy.types.Mesh):
            if update.id.original.session_uid in meshes:
                # In background no timer runs, and one that waits at the end crashes Blender 4.2 on its way out.
                if bpy.app.background:
                    last_result.doubt(lambda: not _holds(result))
                    return
                last_result.set_stale(True)
                if not bpy.app.timers.is_registered(_look_closer):
                    bpy.app.timers.register(_look_closer, first_interval=SECONDS)
                return


@bpy.app.handlers.persistent
def undone(*_):
    """After undo and redo the meshes themselves are looked at."""
    result = last_result.last()
    if result is None or last_result.changing():
        return
    with last_result.own_change():  # Blender tells of what undo changed only after this
        stale = not _holds(result)
    last_result.set_stale(stale)


def _look_closer():
    """Blender also tells of changes where there are none, as on the way into Edit Mode."""
    if any(len(getattr(window, "modal_operators", ())) for window in bpy.context.window_manager.windows):
        return SECONDS  # vertices may be on their way
    undone()
    return None


def _holds(result) -> bool:
    """Whether every mesh and its UVs are as they were written."""
    from .edit_mode import settled_mesh
    from .mesh_reading import fingerprint

    objects = {ob.data.session_uid: ob for ob in bpy.data.objects if ob.type == "MESH"}
    for told in result.objects:
        if not told.fingerprint:
            continue
        ob = objects.get(told.mesh)
        if ob is None:
            return False
        with settled_mesh(ob, in_file=True) as mesh:
            if fingerprint(mesh, told.uv_layer) != told.fingerprint:
                return False
    return True


HANDLERS = ((bpy.app.handlers.depsgraph_update_post, changed),) + tuple(
    (handlers, undone) for handlers in (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post)
)


def register():
    for handlers, handler in HANDLERS:
        handlers.append(handler)


def unregister():
    if bpy.app.timers.is_registered(_look_closer):
        bpy.app.timers.unregister(_look_closer)
    for handlers, handler in HANDLERS:
        handlers.remove(handler)
