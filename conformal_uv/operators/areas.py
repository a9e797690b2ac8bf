"""Areas of faces and of vertices."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..mesh.arrays import face_array, scaled, squared_units, vertex_array
from ..mesh.geometry import TriangleGeometry, triangle_geometry
from ..mesh.manifold import check_areas

__all__ = ["face_areas", "lumped_areas", "mixed_voronoi_areas"]


def face_areas(V: ArrayLike, F: ArrayLike) -> NDArray[np.float64]:
    """Area of each triangle, (m,), in the units of V squared.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> cuv.face_areas([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]).tolist()
    [0.5]
    """
    vertices = vertex_array(V)
    corners = face_array(F, len(vertices))
    vertices, unit = scaled(vertices)
    return squared_units(0.5 * triangle_geometry(vertices, corners).double_area, unit)


def lumped_areas(geometry: TriangleGeometry, corners: NDArray[np.int32], n: int) -> NDArray[np.float64]:
    """A third of the area of the faces around each vertex, (n,)."""
    share = np.tile(geometry.double_area / 6.0, 3)
    return np.bincount(corners.reshape(-1), weights=share, minlength=n).astype(np.float64, copy=False)


def mixed_voronoi_areas(V: ArrayLike, F: ArrayLike) -> NDArray[np.float64]:
    """Mixed Voronoi area of each vertex, (n,); they sum to the area of the surface.

    Inside triangles without an obtuse angle a vertex gets its Voronoi region; an obtuse triangle gives half of
    its area to the obtuse corner and a quarter to each other one (Meyer, Desbrun, Schroeder, Barr 2003, fig. 4).

    Raises
    ------
    MeshError
        On arrays that are not a mesh; DegenerateFaceError on faces without area.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> cuv.mixed_voronoi_areas([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]).tolist()
    [0.25, 0.125, 0.125]
    """
    vertices = vertex_array(V)
    corners = face_array(F, len(vertices))
    vertices, unit = scaled(vertices)
    geometry = triangle_geometry(vertices, corners)
    check_areas(geometry)
    dot, area = geometry.dot, 0.5 * geometry.double_area
    part = geometry.squared_lengths * dot[[2, 0, 1]] / geometry.double_area / 8.0  # |e|^2 cot / 8 of an edge
    voronoi = part + part[[2, 0, 1]]  # the two edges at the corner
    obtuse = dot < 0.0
    share = np.where(obtuse, area / 2.0, area / 4.0)
    share = np.where(obtuse.any(axis=0), share, voronoi).reshape(-1)
    areas = np.bincount(corners.reshape(-1), weights=share, minlength=len(vertices)).astype(np.float64, copy=False)
    return squared_units(areas, unit)
