"""Distortion of texture coordinates on polygons, a number for each, whatever made them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..mesh.polygons import PolygonMesh
from ..mesh.triangulate import triangulate
from .distortion import distortion

__all__ = ["PolygonDistortion", "polygon_distortion"]

Real = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class PolygonDistortion:
    """Of each polygon.

    Attributes
    ----------
    angle_error : (p,) float64
        Mean over the corners of the polygon's triangles, degrees.
    area_scale : (p,) float64
        Area in the texture over area on the surface, as a multiple of that ratio for all polygons together; 0 where
        nothing is in the texture, infinite where a polygon without area is.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> mesh = cuv.PolygonMesh(np.eye(3), np.array([0, 1, 2]), np.array([0, 3]))
    >>> found = cuv.polygon_distortion(mesh, [[0, 0], [1, 0], [0.5, 0.75**0.5]])
    >>> found.angle_error.round(9).tolist(), found.area_scale.round(9).tolist()
    ([0.0], [1.0])
    """

    angle_error: Real
    area_scale: Real


def polygon_distortion(mesh: PolygonMesh, corner_uv: ArrayLike) -> PolygonDistortion:
    """Distortion of every polygon.

    Parameters
    ----------
    mesh : PolygonMesh
    corner_uv : (k, 2)
        Coordinates of every polygon corner; what is not finite counts as 0.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> V = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]])
    >>> mesh = cuv.PolygonMesh(V, np.array([0, 1, 2, 3, 1, 4, 5, 2]), np.array([0, 4, 8]))
    >>> uv = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [1, 0], [4, 0], [4, 1], [1, 1]])
    >>> found = cuv.polygon_distortion(mesh, uv)
    >>> found.area_scale.tolist(), found.angle_error.round(1).tolist()
    ([0.5, 1.5], [0.0, 17.7])
    """
    _, polygon, corner = triangulate(mesh)
    count = len(mesh.sizes)
    uv = np.nan_to_num(np.asarray(corner_uv, dtype=np.float64), posinf=0.0, neginf=0.0)
    V = np.nan_to_num(mesh.V[mesh.corners], posinf=0.0, neginf=0.0)
    if not len(polygon):
        return PolygonDistortion(np.zeros(count), np.zeros(count))
    error = distortion(V, corner, uv).angle_error.sum(axis=1)
    angle = np.bincount(polygon, error, minlength=count) / np.maximum(3 * np.bincount(polygon, minlength=count), 1)
    there, here = (np.bincount(polygon, _areas(P[corner]), minlength=count) for P in (uv, V))
    with np.errstate(divide="ignore", invalid="ignore"):
        overall = there.sum() / here.sum()
        scale = there / here / overall
    scale[np.isnan(scale)] = 0.0
    return PolygonDistortion(angle, scale)


def _areas(P: Real) -> Real:
    """Of triangles (m, 3, 2 or 3)."""
    a, b = P[:, 1] - P[:, 0], P[:, 2] - P[:, 0]
    if P.shape[2] == 2:
        return np.asarray(0.5 * np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]))
    return np.asarray(0.5 * np.linalg.norm(np.cross(a, b), axis=1))
