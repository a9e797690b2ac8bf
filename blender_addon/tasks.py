"""What is to be unwrapped: objects read, with the reasons where nothing can be done."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import bpy
import numpy as np
from numpy.typing import NDArray

from conformal_uv import Unwrapped

from .edit_mode import active_vertex, settled_mesh
from .image_aspect import image_scale
from .kept_work import Surface
from .mesh_reading import MeshArrays, read_mesh, selected_uvs
from .pins import HOW_TO_USE, NO_CORNERS, held_uvs, offered_pins, took_pins
from .properties import Options
from .subdivided import Subdivision, read_subdivided
from .uv_layers import has_room, holds_vectors, uv_layer_name
from .words import told

NO_ACTIVE = "no vertex is active, the center is automatic; in Edit Mode, click a vertex first"
NO_FACE = "no visible face is selected"
NO_VISIBLE = "no face is visible"
ONLY_VERTICES = (
    "no visible face is selected; turn on Use Pins where selected vertices are to be corners of all visible faces' "
    "islands"
)
UNEVEN = "the scale is not uniform, and the mesh is mapped without it; apply it first (Ctrl A)"
SCALES_ALIKE = 1e-4  # of the largest one, as Blender's own unwrap takes them


@dataclass(eq=False)
class Task:
    """One object to unwrap.

    Attributes
    ----------
    refusal : str
        Why nothing can be done, empty where something can.
    mendable : bool
        Whether other options would do although nothing was read.
    pinned, unselected : (q,) bool
        The object's own faces with a pinned UV, and with a UV that is not selected where only selected ones are taken.
    subdivision : Subdivision or None
        Where the surface is not the mesh itself, the way back to the mesh.
    solved : Unwrapped or None
        Not placed: every chart in the square [-1, 1]^2.
    left : dict of int to str
        Charts that are mapped but not to be written, and why.
    """

    ob: bpy.types.Object
    layer: str
    surface: Surface | None
    refusal: str = ""
    mendable: bool = False
    pinned: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(0, dtype=bool))
    unselected: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(0, dtype=bool))
    subdivision: Subdivision | None = None
    notes: list[str] = field(default_factory=list)
    solved: Unwrapped | None = None
    left: dict[int, str] = field(default_factory=dict)

    def own_faces(self, faces: NDArray[np.int64]) -> NDArray[np.int64]:
        """The object's faces for some of the surface's."""
        return faces if self.subdivision is None else self.subdivision.faces_of(faces)

    def take(self, solved: Unwrapped, options: Options) -> None:
        """Keep what was solved, and find the islands whose UVs are to stay as they are."""
        self.solved, self.left = solved, {}
        if not (self.pinned.any() or self.unselected.any()):
            return
        offered = offered_pins(self.surface.arrays, self.surface.chosen, options)
        for number in np.flatnonzero(solved.charts.mapped).tolist():
            chart = solved.charts[number]
            own = self.own_faces(chart.faces)
            if self.pinned[own].any() and not (solved.charts.held[number] or took_pins(chart, offered)):
                self.left[number] = told(HOW_TO_USE[options.shape])
            elif self.unselected[own].any():
                self.left[number] = told("some of its UVs are not selected; select whole islands")

    @property
    def written(self) -> NDArray[np.bool_]:
        """Charts with new UVs, (c,)."""
        if self.solved is None:
            return np.zeros(0, dtype=bool)
        done = self.solved.charts.mapped.copy()
        done[list(self.left)] = False
        return done

    @property
    def held(self) -> NDArray[np.bool_]:
        """Charts that stay where their pins are, (c,)."""
        return np.zeros(0, dtype=bool) if self.solved is None else self.solved.charts.held

    @property
    def mapped(self) -> NDArray[np.bool_]:
        """Faces of the surface with new UVs, (p,)."""
        return self.solved.mapped & np.append(self.written, False)[self.solved.chart_of_face]


def even_scale(ob: bpy.types.Object) -> bool:
    """Whether an object's scale keeps angles."""
    sizes = [abs(size) for size in ob.matrix_world.to_scale()]
    return max(sizes) - min(sizes) <= SCALES_ALIKE * max(sizes)


def gather(context: bpy.types.Context, objects: Iterable[bpy.types.Object], options: Options) -> list[Task]:
    """Read the objects' meshes; a task for each."""
    tasks = [_task(context, ob, options) for ob in objects]
    for task in tasks:
        if task.surface is None:
            continue
        if not even_scale(task.ob):
            task.notes.append(told(UNEVEN))
        if options.takes_active and task.surface.active is None:
            task.notes.append(told(NO_ACTIVE))
        if options.takes_selected_corners and not offered_pins(task.surface.arrays, task.surface.chosen, options):
            task.notes.append(told(NO_CORNERS))
    return tasks


def _task(context: bpy.types.Context, ob: bpy.types.Object, options: Options) -> Task:
    layer = uv_layer_name(ob.data, options.uv_layer)
    refusal = _refusal(ob, ob.data, layer)
    if refusal:
        return Task(ob, layer, None, refusal)
    with settled_mesh(ob) as mesh:
        arrays = read_mesh(mesh, layer)
    chosen = _chosen(ob, arrays, options)
    unselected = np.zeros(len(chosen), dtype=bool)
    if options.faces == "SELECTED" and options.only_selected_uvs and ob.mode == "EDIT":
        with settled_mesh(ob) as mesh:
            uvs = selected_uvs(mesh)
        face = np.repeat(np.arange(len(chosen)), np.diff(arrays.starts))
        count = np.bincount(face[uvs], minlength=len(chosen))
        chosen &= count > 0
        unselected = count < np.diff(arrays.starts)
        if not chosen.any():
            return Task(ob, layer, None, told("no UV is selected"))
    if not chosen.any():
        only_vertices = options.shape == "RECTANGLE" and len(arrays.alone) > 0
        why = told((ONLY_VERTICES if only_vertices else NO_FACE) if ob.mode == "EDIT" else NO_VISIBLE)
        return Task(ob, layer, None, why, mendable=only_vertices)
    active = active_vertex(ob) if options.takes_active else None
    if active is not None and not np.isin(active, arrays.corners[np.repeat(chosen, np.diff(arrays.starts))]):
        return Task(ob, layer, None, told("active vertex {vertex} belongs to no selected face", vertex=active))
    pinned = arrays.pinned
    held = held_uvs(arrays, chosen, image_scale(ob, options)) if options.holds_pins else {}
    subdivision = read_subdivided(context, ob, arrays) if options.use_subsurf_data else None
    if subdivision is not None:
        arrays, chosen = subdivision.arrays, chosen[subdivision.face]
        held = {int(subdivision.corner[corner]): place for corner, place in held.items()}
    return Task(
        ob,
        layer,
        Surface(arrays, chosen, active, held),
        pinned=pinned,
        unselected=unselected,
        subdivision=subdivision,
    )


def _chosen(ob: bpy.types.Object, arrays: MeshArrays, options: Options) -> NDArray[np.bool_]:
    """Faces to unwrap, (p,)."""
    visible = ~arrays.hidden
    selected = visible & arrays.selected
    if options.faces == "ALL" or (ob.mode != "EDIT" and not selected.any()):
        return visible
    if options.takes_selected_corners and len(arrays.alone) and not selected.any():
        return visible
    return selected


def _refusal(ob: bpy.types.Object, mesh: bpy.types.Mesh, layer: str) -> str:
    """Why a mesh can not be unwrapped, before anything of it is read."""
    if mesh.is_editmode and ob.mode != "EDIT":
        return told("the mesh is in Edit Mode through another object; leave Edit Mode there")
    if mesh.library is not None:
        return told("the mesh is linked from another file; make it local first")
    if not len(mesh.polygons) and not mesh.is_editmode:
        return told("the mesh has no faces")
    if not has_room(mesh, layer):
        return told(
            "there is no UV map {name!r} and no room for it: Blender keeps eight UV maps in a mesh; "
            "remove one or name one of them",
            name=layer,
        )
    other = mesh.attributes.get(layer)
    if other is not None and mesh.uv_layers.get(layer) is None and not holds_vectors(mesh, layer):
        return told("{name!r} is an attribute, but no vector of face corners; choose another name", name=layer)
    return ""
