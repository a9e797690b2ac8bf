"""Texture coordinates, texture and quality onto the current mesh, which keeps all else that it has."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike, fspath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from conformal_uv import ConformalUVError

from .current_mesh import CurrentMesh
from .function_filters import face_variable, vertex_variable
from .library import pymeshlab

__all__ = ["Texcoords", "check_texture", "new_texcoords", "write_face_scalar", "write_texcoords"]

Real = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Texcoords:
    """What is to be written.

    Attributes
    ----------
    wedge : (m, 3, 2) float64
        Of every face corner.
    vertex : (n, 2) float64
        Of every vertex: that of its first mapped wedge.
    torn : (n,) bool
        Vertices whose mapped wedges are not all in one place.
    as_vertices : bool
        Whether all wedges are where their vertices are.
    """

    wedge: Real
    vertex: Real
    torn: NDArray[np.bool_]
    as_vertices: bool


def check_texture(texture: str | PathLike[str]) -> None:
    """Raise ConformalUVError on an image that pymeshlab can not load."""
    scratch = pymeshlab.MeshSet()
    scratch.add_mesh(pymeshlab.Mesh(np.eye(3), [[0, 1, 2]], v_tex_coords_matrix=np.zeros((3, 2))))
    scratch.compute_texcoord_transfer_vertex_to_wedge()
    try:
        scratch.set_texture_per_mesh(textname=fspath(texture))
    except pymeshlab.PyMeshLabException as error:
        reason = " ".join(str(error).partition("Details:")[2].split()) or str(error)
        raise ConformalUVError(f"The texture can not be used: {reason}; pass an image file.") from error


def new_texcoords(source: CurrentMesh, uv: Real, mapped: NDArray[np.bool_]) -> Texcoords:
    """Put the polygon corners' coordinates uv (k, 2) of the mapped polygons (p,) over those that the mesh has."""
    mesh, F = source.mesh, source.F
    wedge = np.zeros((len(F), 3, 2))
    if mesh.has_wedge_tex_coord():
        wedge[:] = mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
    vertex = np.zeros((len(source.polygons.V), 2))
    if mesh.has_vertex_tex_coord():
        vertex[:] = mesh.vertex_tex_coord_matrix()
    new = mapped[source.wedges.polygon]
    wedge[new] = uv[source.wedges.corner].reshape(-1, 3, 2)[new]
    corner, place = F[new].reshape(-1), wedge[new].reshape(-1, 2)
    vertex[corner[::-1]] = place[::-1]  # of several the first stays
    torn = np.zeros(len(vertex), dtype=bool)
    torn[corner[(vertex[corner] != place).any(axis=1)]] = True
    return Texcoords(wedge, vertex, torn, bool(new.all()) and not torn.any())


def write_texcoords(ms: Any, mesh: Any, texcoords: Texcoords, texture: str | PathLike[str] | None) -> None:
    """Write vertex and wedge texture coordinates, and link the image.

    Wedges are first copied from the vertices, which sets their texture index to 0: without an index OBJ and DAE lose
    the texture. A mesh that comes with textures and gets no other keeps its indices.
    """
    keeps_index = mesh.has_wedge_tex_coord() and mesh.texture_number() > 0 and texture is None
    u, v = (vertex_variable(mesh, name, texcoords.vertex[:, k]) for k, name in enumerate("uv"))
    ms.compute_texcoord_by_function_per_vertex(u=u, v=v)
    if not keeps_index:
        ms.compute_texcoord_transfer_vertex_to_wedge()
    if keeps_index or not texcoords.as_vertices:
        names = {f"{'uv'[j]}{k}": texcoords.wedge[:, k, j] for k in range(3) for j in range(2)}
        ms.compute_texcoord_by_function_per_wedge(**{key: face_variable(mesh, key, x) for key, x in names.items()})
    if texture is not None:
        ms.set_texture_per_mesh(textname=fspath(texture))


def write_face_scalar(ms: Any, mesh: Any, values: Real, new: NDArray[np.bool_]) -> None:
    """Write values (m,) as per-face scalars; faces that are not `new` keep theirs, or have 0."""
    kept = mesh.face_scalar_array() if mesh.has_face_scalar() else np.zeros(len(new))
    ms.compute_scalar_by_function_per_face(q=face_variable(mesh, "quality", np.where(new, values, kept)))
