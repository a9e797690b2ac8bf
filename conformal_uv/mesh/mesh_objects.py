"""Meshes as other libraries keep them, told by their attributes; nothing of these libraries is imported."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import MeshError
from .polygons import PolygonMesh

__all__ = ["MeshObject", "polygons_of", "triangles_of"]

MeshObject = Any  # known by its attributes
Ints = NDArray[np.int64]

TAKEN = (
    "a pair (V, F), a trimesh.Trimesh, a pyvista.PolyData, a meshio.Mesh, an open3d.geometry.TriangleMesh "
    "or a PolygonMesh"
)
SURFACE_CELLS = ("triangle", "quad", "polygon")  # of meshio; with the number of corners behind the last


def triangles_of(V: Any, F: ArrayLike | None) -> tuple[ArrayLike, ArrayLike]:
    """Vertices and triangles: V and F where both are given, else those of the mesh that V is.

    Raises
    ------
    MeshError
        V is no mesh that is known, or has other polygons than triangles.
    """
    if F is not None:
        return V, F
    points, polygons = _parts(V)
    blocks = list(polygons) if isinstance(polygons, tuple) else [polygons]
    if isinstance(polygons, PolygonMesh):
        blocks = [polygons.corners.reshape(-1, 3)] if (polygons.sizes == 3).all() else []
    if not blocks or any(np.ndim(block) == 2 and np.shape(block)[1] != 3 for block in blocks):
        raise MeshError(f"The {_name(V)} has polygons that are no triangles; unwrap() takes them, or triangulate it.")
    return points, blocks[0] if len(blocks) == 1 else np.concatenate(blocks)


def polygons_of(V: Any, polygons: Any) -> tuple[Any, Any]:
    """Vertices and polygons: V and `polygons` where the latter are given, else those of the mesh that V is.

    Raises
    ------
    MeshError
        V is no mesh that is known.
    """
    if polygons is not None:
        return V, polygons
    points, found = _parts(V)
    if not isinstance(found, tuple):
        return points, found
    if len(found) == 1:
        return points, found[0]
    corners = np.concatenate([block.reshape(-1) for block in found])
    sizes = np.concatenate([np.full(len(block), block.shape[1]) for block in found])
    return points, PolygonMesh(np.asarray(points), corners, np.concatenate(([0], np.cumsum(sizes))))


def _parts(mesh: Any) -> tuple[Any, Any]:
    """Vertices, and polygons as given, a tuple of arrays with so many corners a row each, or a PolygonMesh."""
    if isinstance(mesh, tuple) and len(mesh) == 2:
        return mesh
    if isinstance(mesh, PolygonMesh):
        return mesh.V, mesh
    if hasattr(mesh, "points") and hasattr(mesh, "cells_dict"):
        return mesh.points, _cells(mesh)
    if hasattr(mesh, "points") and hasattr(mesh, "faces"):
        return mesh.points, _padded(mesh)
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return mesh.vertices, mesh.faces
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):  # a trimesh.Trimesh has other triangles
        return np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    if isinstance(mesh, np.ndarray | list):
        raise MeshError("F is missing: pass vertices and faces, or one mesh object.")
    raise MeshError(f"A {_name(mesh)} is no mesh that is known; pass V and F, or {TAKEN}.")


def _cells(mesh: Any) -> tuple[Ints, ...]:
    """Polygons of a meshio.Mesh, a block for each number of corners; lines and points are left out."""
    blocks = {name: np.asarray(block) for name, block in mesh.cells_dict.items() if block is not None}
    found = [block for name, block in blocks.items() if name.rstrip("0123456789") in SURFACE_CELLS and block.ndim == 2]
    if not found:
        raise MeshError(f"The {_name(mesh)} has no polygons but cells {', '.join(blocks) or 'none'}; pass its surface.")
    return tuple(block.astype(np.int64, copy=False) for block in found)


def _padded(mesh: Any) -> Any:
    """Polygons of a pyvista.PolyData, whose faces are one list: number of corners, corners, and again."""
    flat = np.asarray(mesh.faces)
    if flat.ndim == 2:
        return flat
    strips = getattr(mesh, "n_strips", 0)
    if strips:
        raise MeshError(f"The {_name(mesh)} has {strips} triangle strips; call its triangulate() first.")
    begins = _begins(flat, _name(mesh))
    sizes = flat[begins]
    if not len(sizes):
        raise MeshError(f"The {_name(mesh)} has no faces; there is nothing to map.")
    corner = np.ones(len(flat), dtype=bool)
    corner[begins] = False
    corners = flat[corner].astype(np.int64)
    if (sizes == sizes[0]).all():
        return corners.reshape(len(sizes), -1)
    return PolygonMesh(np.asarray(mesh.points), corners, np.concatenate(([0], np.cumsum(sizes))).astype(np.int64))


def _begins(flat: NDArray[Any], name: str) -> Ints:
    """Where the numbers of corners stand: from each place one leads on to the next, in ever longer leaps."""
    if not len(flat):
        return np.empty(0, dtype=np.int64)
    size = int(flat[0])
    if size > 0 and len(flat) % (size + 1) == 0 and (flat[:: size + 1] == size).all():
        return np.arange(0, len(flat), size + 1)
    end = len(flat)
    leap = np.minimum(np.arange(end) + np.maximum(flat, 0) + 1, end + 1)  # one beyond the end, if the list is cut off
    leap = np.append(leap, (end, end + 1))
    found = np.zeros(1, dtype=np.int64)
    while found[-1] < end:
        found = np.concatenate((found, leap[found]))
        leap = leap[leap]
    found = found[: np.searchsorted(found, end) + 1]
    if found[-1] != end:
        raise MeshError(f"The faces of the {name} are no list of numbers of corners and corners; pass V and F.")
    return found[:-1]


def _name(mesh: Any) -> str:
    return type(mesh).__name__
