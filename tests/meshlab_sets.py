"""MeshSets for the tests of the filters, and all that a MeshSet holds, to tell what a filter changed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pymeshlab
from numpy.typing import NDArray

TEXCOORDS = ("vertex_tex_coords", "wedge_tex_coords")

_KEPT: list[Any] = []  # a mesh of pymeshlab's dies with its MeshSet, whoever still has it


def loaded(path: Path) -> Any:
    """The mesh of a file, in a MeshSet of its own."""
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(path))
    _KEPT.append(ms)
    return ms.current_mesh()


def mesh_set(V: NDArray, F: NDArray, label: str = "patient", **more: NDArray) -> Any:
    """A MeshSet whose current mesh, of three, has colours, scalars, custom attributes and a selection."""
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(np.eye(3), [[0, 1, 2]]), "before")
    n, m = len(V), len(F)
    mesh = pymeshlab.Mesh(
        V,
        F,
        v_color_matrix=np.column_stack([np.linspace(0.1, 0.9, n)] * 3 + [np.ones(n)]),
        f_color_matrix=np.column_stack([np.linspace(0.9, 0.2, m)] * 3 + [np.ones(m)]),
        v_scalar_array=np.linspace(-1.0, 1.0, n),
        f_scalar_array=np.linspace(5.0, 6.0, m),
        **more,
    )
    ms.add_mesh(mesh, label)
    mine = ms.current_mesh_id()
    ms.add_mesh(pymeshlab.Mesh(2 * np.eye(3), [[0, 1, 2]]), "after")
    ms.set_current_mesh(mine)
    ms.current_mesh().add_vertex_custom_scalar_attribute(np.arange(float(n)), "age")
    ms.current_mesh().add_face_custom_scalar_attribute(np.arange(float(m)), "weight")
    ms.compute_selection_by_condition_per_face(condselect="sin(fi) > 0.3")
    ms.compute_selection_by_condition_per_vertex(condselect="sin(vi) > 0.6")
    return ms


def wedges(ms: Any) -> NDArray:
    """Wedge texture coordinates of the current mesh, (m, 3, 2)."""
    return ms.current_mesh().wedge_tex_coord_matrix().reshape(-1, 3, 2)


def contents(ms: Any) -> dict[str, Any]:
    """The MeshSet's current mesh, its number of meshes, and everything of each of them."""
    told: dict[str, Any] = {"current": ms.current_mesh_id(), "meshes": ms.mesh_number()}
    for mesh in ms:
        told |= {f"{mesh.id()} {key}": value for key, value in mesh_contents(mesh).items()}
    return told


def mesh_contents(mesh: Any) -> dict[str, Any]:
    """Everything of a mesh."""
    told = {
        "label": mesh.label(),
        "vertices": mesh.vertex_matrix(),
        "faces": mesh.face_matrix(),
        "sizes": np.array([len(p) for p in mesh.polygonal_face_list()]),
        "vertex_normals": mesh.vertex_normal_matrix(),
        "face_normals": mesh.face_normal_matrix(),
        "vertex_selection": mesh.vertex_selection_array(),
        "face_selection": mesh.face_selection_array(),
        "transform": mesh.transform_matrix(),
        "textures": sorted(mesh.textures()),
        "visible": mesh.is_visible(),
    }
    optional = {
        "vertex_colors": (mesh.has_vertex_color, mesh.vertex_color_matrix),
        "face_colors": (mesh.has_face_color, mesh.face_color_matrix),
        "vertex_scalars": (mesh.has_vertex_scalar, mesh.vertex_scalar_array),
        "face_scalars": (mesh.has_face_scalar, mesh.face_scalar_array),
        "vertex_tex_coords": (mesh.has_vertex_tex_coord, mesh.vertex_tex_coord_matrix),
        "wedge_tex_coords": (mesh.has_wedge_tex_coord, mesh.wedge_tex_coord_matrix),
    }
    for name, (has, read) in optional.items():
        told[name] = np.array(read()) if has() else None
    for name, read in (
        ("age", mesh.vertex_custom_scalar_attribute_array),
        ("weight", mesh.face_custom_scalar_attribute_array),
    ):
        try:
            told[name] = np.array(read(name))
        except pymeshlab.PyMeshLabException:
            told[name] = None
    return told


def changed(before: dict[str, Any], after: dict[str, Any]) -> set[str]:
    """Names of what differs, the mesh's number left out; arrays are compared bit by bit."""
    assert before.keys() == after.keys()
    return {key.rpartition(" ")[2] for key in before if not _same(before[key], after[key])}


def _same(a: Any, b: Any) -> bool:
    if not (isinstance(a, np.ndarray) and isinstance(b, np.ndarray)):
        return type(a) is type(b) and a == b
    equal = a.shape == b.shape and a.dtype == b.dtype
    return equal and bool(np.array_equal(a, b, equal_nan=a.dtype.kind == "f"))
