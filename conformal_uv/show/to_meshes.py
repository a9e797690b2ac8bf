"""A result as the mesh objects of other libraries."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..mapped_mesh import AnyMap, MappedMesh, mapped_mesh
from .libraries import library

if TYPE_CHECKING:
    from pyvista import PolyData
    from trimesh import Trimesh

__all__ = ["to_pyvista", "to_trimesh"]

Real = NDArray[np.float64]


def to_trimesh(result: AnyMap, *, image: bool = False) -> Trimesh:
    """See `Shown.to_trimesh`."""
    trimesh = library("trimesh", "to_trimesh()", "trimesh")
    mapped = mapped_mesh(result)
    told: dict[str, Any] = {"vertex_attributes": {"original_vertex": mapped.vertices}}
    if mapped.shape == "sphere":
        told["vertex_attributes"]["sphere"] = mapped.image
    else:
        told["visual"] = trimesh.visual.TextureVisuals(uv=_texture(mapped))
    told["face_attributes"] = {"angle_error": _angle(mapped), "area_scale": mapped.distortion.area_scale}
    return trimesh.Trimesh(_positions(mapped, image), mapped.F, process=False, validate=False, **told)


def to_pyvista(result: AnyMap, *, image: bool = False) -> PolyData:
    """See `Shown.to_pyvista`."""
    pyvista = library("pyvista", "to_pyvista()", "pyvista")
    mapped = mapped_mesh(result)
    mesh = pyvista.PolyData.from_regular_faces(_positions(mapped, image), mapped.F)
    mesh.point_data["original vertex"] = mapped.vertices
    if mapped.shape == "sphere":
        mesh.point_data["sphere"] = mapped.image
    else:
        mesh.active_texture_coordinates = _texture(mapped)
    mesh.cell_data["area scale"] = mapped.distortion.area_scale
    mesh.cell_data["angle error"] = _angle(mapped)
    return mesh


def _angle(mapped: MappedMesh) -> Real:
    return mapped.distortion.angle_error.mean(axis=1)


def _positions(mapped: MappedMesh, image: bool) -> Real:
    if not image:
        return mapped.V
    flat = mapped.image.shape[1] == 2
    return np.column_stack((mapped.image, np.zeros(len(mapped.V)))) if flat else mapped.image


def _texture(mapped: MappedMesh) -> Real:
    """The map in the unit square: a disk fills it, other shapes one way, charts lie there already."""
    if mapped.shape == "charts":
        return mapped.image
    if mapped.shape == "disk":
        return 0.5 + 0.5 * mapped.image
    low, high = mapped.image.min(axis=0), mapped.image.max(axis=0)
    return (mapped.image - 0.5 * (low + high)) / max(float((high - low).max()), 1e-300) + 0.5
