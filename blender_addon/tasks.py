"""What is to be unwrapped: objects read, with the reasons where nothing can be done."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import bpy
import numpy as np

from conformal_uv import Unwrapped

from .edit_mode import active_vertex, settled_mesh
from .kept_work import Surface
from .mesh_io import has_room, read_mesh, uv_layer_name
from .properties import Options
from .subdivided import Subdivision, read_subdivided


@dataclass(eq=False)
class Task:
    """One object to unwrap.

    Attributes
    ----------
    refusal : str
        Why nothing can be done, empty where something can.
    subdivision : Subdivision or None
        Where the surface is not the mesh itself, the way back to the mesh.
    """

    ob: bpy.types.Object
    layer: str
    surface: Surface | None
    refusal: str = ""
    subdivision: Subdivision | None = None
    solved: Unwrapped | None = None


def gather(context: bpy.types.Context, objects: Iterable[bpy.types.Object], options: Options) -> list[Task]:
    """Read the objects' meshes; a task for each."""
    return [_task(context, ob, options) for ob in objects]


def _task(context: bpy.types.Context, ob: bpy.types.Object, options: Options) -> Task:
    layer = uv_layer_name(ob.data, options.uv_layer)
    refusal = _refusal(ob, ob.data, layer)
    if refusal:
        return Task(ob, layer, None, refusal)
    with settled_mesh(ob) as mesh:
        arrays = read_mesh(mesh, layer)
    chosen = ~arrays.hidden
    if options.faces == "SELECTED" and (ob.mode == "EDIT" or (chosen & arrays.selected).any()):
        chosen &= arrays.selected
    if not chosen.any():
        return Task(ob, layer, None, "no visible face is selected" if ob.mode == "EDIT" else "no face is visible")
    active = active_vertex(ob) if options.center == "ACTIVE" else None
    if active is not None and not np.isin(active, arrays.corners[np.repeat(chosen, np.diff(arrays.starts))]):
        return Task(ob, layer, None, f"active vertex {active} belongs to no selected face")
    subdivision = read_subdivided(context, ob, arrays) if options.use_subsurf_data else None
    if subdivision is not None:
        arrays, chosen = subdivision.arrays, chosen[subdivision.face]
    return Task(ob, layer, Surface(arrays, chosen, active), subdivision=subdivision)


def _refusal(ob: bpy.types.Object, mesh: bpy.types.Mesh, layer: str) -> str:
    """Why a mesh can not be unwrapped, before anything of it is read."""
    if mesh.is_editmode and ob.mode != "EDIT":
        return "the mesh is in Edit Mode through another object; leave Edit Mode there"
    if mesh.library is not None:
        return "the mesh is linked from another file; make it local first"
    if not len(mesh.polygons) and not mesh.is_editmode:
        return "the mesh has no faces"
    if not has_room(mesh, layer):
        return (
            f"there is no UV map {layer!r} and no room for it: Blender keeps eight UV maps in a mesh; "
            "remove one or name one of them"
        )
    other = mesh.attributes.get(layer)
    if other is not None and mesh.uv_layers.get(layer) is None:
        return f"{layer!r} is an attribute that is no UV map; choose another name"
    return ""
