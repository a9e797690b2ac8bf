"""The gradient of piecewise linear functions."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csr_array

from ..mesh.arrays import face_array, scaled, vertex_array
from ..mesh.geometry import triangle_geometry
from ..mesh.manifold import check_areas

__all__ = ["gradient"]


def gradient(V: ArrayLike, F: ArrayLike) -> csr_array:
    """Gradient operator of a triangle mesh.

    Returns
    -------
    (3 m, n) csr_array
        Rows 3 f .. 3 f + 2 give the gradient vector of a vertex function on face f. With M the face areas
        repeated three times, G' M G is the cotangent Laplacian.

    Raises
    ------
    MeshError
        On arrays that are not a mesh; DegenerateFaceError on faces without area.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> V = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    >>> G = cuv.gradient(V, [[0, 1, 2]])
    >>> (G @ [1.0, 3.0, 1.0]).tolist()
    [2.0, 0.0, 0.0]
    """
    vertices = vertex_array(V)
    corners = face_array(F, len(vertices))
    vertices, unit = scaled(vertices)
    geometry = triangle_geometry(vertices, corners)
    check_areas(geometry)
    a, b, c = vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]
    normal = np.cross(b - a, c - a) / geometry.double_area[:, None] ** 2
    turned = np.stack([np.cross(normal, side) for side in (c - b, a - c, b - a)])  # (corner, face, axis)
    with np.errstate(over="ignore", under="ignore"):
        turned /= unit
    m = corners.shape[1]
    rows = np.broadcast_to(3 * np.arange(m)[:, None] + np.arange(3), (3, m, 3))
    columns = np.broadcast_to(corners[:, :, None], (3, m, 3))
    return csr_array((turned.reshape(-1), (rows.reshape(-1), columns.reshape(-1))), shape=(3 * m, len(vertices)))
