"""The cotangent Laplacian and the uniform one, as edge weights and as matrices.

L is positive semidefinite: ``L[i, j] = -w_ij``, ``L[i, i] = sum_j w_ij``, with w_ij = (cot a + cot b) / 2 over the
angles opposite to the edge (Pinkall and Polthier 1993, eq. 6); 1/2 x' L x is the Dirichlet energy of x.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array

from ..errors import MeshError
from ..mesh.arrays import face_array, scaled, vertex_array
from ..mesh.blocks import by_blocks
from ..mesh.geometry import TriangleGeometry, triangle_geometry
from ..mesh.halfedges import HalfEdges, half_edges
from ..mesh.manifold import check_areas

__all__ = [
    "cotangent_laplacian",
    "cotangent_laplacian_intrinsic",
    "cotangent_weights",
    "intrinsic_geometry",
    "laplacian_matrix",
    "uniform_laplacian",
    "uniform_weights",
]


def cotangent_laplacian(V: ArrayLike, F: ArrayLike) -> csr_array:
    """Cotangent Laplacian of a triangle mesh.

    Parameters
    ----------
    V : (n, 3) floats
    F : (m, 3) integers

    Returns
    -------
    (n, n) csr_array, positive semidefinite, rows summing to 0.

    Raises
    ------
    MeshError
        On arrays that are not a mesh; DegenerateFaceError on faces without area.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> L = cuv.cotangent_laplacian([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> L.toarray().round(12).tolist()
    [[1.0, -0.5, -0.5], [-0.5, 0.5, 0.0], [-0.5, 0.0, 0.5]]
    """
    vertices, _ = scaled(vertex_array(V))  # the matrix is the same in any unit
    corners = face_array(F, len(vertices))
    return _matrix(triangle_geometry(vertices, corners), corners, len(vertices))


def cotangent_laplacian_intrinsic(lengths: ArrayLike, F: ArrayLike, n: int | None = None) -> csr_array:
    """Cotangent Laplacian from edge lengths alone.

    Parameters
    ----------
    lengths : (m, 3) floats
        Length of the edge opposite to each corner.
    F : (m, 3) integers
    n : int, optional
        Number of vertices; the largest index in F plus one by default.

    Returns
    -------
    (n, n) csr_array

    Raises
    ------
    MeshError
        DegenerateFaceError where lengths break the triangle inequality or leave no area.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> L = cuv.cotangent_laplacian_intrinsic([[5.0, 4.0, 3.0]], [[0, 1, 2]])
    >>> L.diagonal().round(6).tolist()
    [1.041667, 0.666667, 0.375]
    """
    corners, count = _counted(F, n)
    opposite = np.ascontiguousarray(vertex_array(lengths).T)
    if opposite.shape != corners.shape or opposite.min() < 0.0:
        raise MeshError(f"lengths must be ({corners.shape[1]}, 3) and not negative, one opposite to each corner.")
    opposite, _ = scaled(opposite)
    return _matrix(intrinsic_geometry(opposite[[2, 0, 1]]), corners, count)


def intrinsic_geometry(lengths: NDArray[np.float64]) -> TriangleGeometry:
    """Geometry of triangles from the lengths (3, m) of their half-edges.

    The area is Heron's formula in the order that keeps it accurate for needles (Kahan 2014); 0 where the
    triangle inequality fails.
    """
    x, y, z = lengths
    low, high = np.minimum(x, y), np.maximum(x, y)
    c, b, a = np.minimum(low, z), np.maximum(low, np.minimum(high, z)), np.maximum(high, z)
    square = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c))
    double_area = 0.5 * np.sqrt(np.maximum(square, 0.0))
    squared = lengths * lengths
    dot = 0.5 * (squared + squared[[2, 0, 1]] - squared[[1, 2, 0]])
    return TriangleGeometry(dot, double_area)


def uniform_laplacian(F: ArrayLike, n: int | None = None) -> csr_array:
    """Graph Laplacian, all weights 1 (Tutte 1963), for faces F (m, 3) over n vertices.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> cuv.uniform_laplacian([[0, 1, 2]]).diagonal().tolist()
    [2.0, 2.0, 2.0]
    """
    corners, count = _counted(F, n)
    edges = half_edges(corners, count)
    return laplacian_matrix(edges, uniform_weights(edges), count)


def cotangent_weights(edges: HalfEdges, geometry: TriangleGeometry) -> NDArray[np.float64]:
    """Weight (cot a + cot b) / 2 of every edge, (e,)."""
    doubled = 2.0 * geometry.double_area
    half_cot = np.empty_like(geometry.dot)

    def divide(part: slice) -> None:
        for c in range(3):  # the corner opposite to half-edge c is c + 2
            np.divide(geometry.dot[c - 1, part], doubled[part], out=half_cot[c, part])

    by_blocks(divide, len(doubled))
    weights = np.bincount(edges.edge, weights=half_cot.reshape(-1), minlength=len(edges.lo))
    return weights.astype(np.float64, copy=False)


def uniform_weights(edges: HalfEdges) -> NDArray[np.float64]:
    """Weight 1 of every edge, (e,)."""
    return np.ones(len(edges.lo))


def laplacian_matrix(edges: HalfEdges, weights: NDArray[np.float64], n: int) -> csr_array:
    """The Laplacian with the given edge weights as an (n, n) matrix."""
    lo, hi = edges.lo, edges.hi
    diagonal = np.arange(n, dtype=np.int32)
    degree = np.bincount(lo, weights, n) + np.bincount(hi, weights, n)
    rows = np.concatenate((lo, hi, diagonal))
    columns = np.concatenate((hi, lo, diagonal))
    return csr_array((np.concatenate((-weights, -weights, degree)), (rows, columns)), shape=(n, n))


def _counted(F: ArrayLike, n: int | None) -> tuple[NDArray[np.int32], int]:
    """Faces (3, m), and the number of vertices: the largest index plus one where it is not given."""
    most = 2**31 - 1
    corners = face_array(F, most if n is None else int(n))
    return corners, int(corners.max()) + 1 if n is None else int(n)


def _matrix(geometry: TriangleGeometry, corners: NDArray[np.int32], n: int) -> csr_array:
    check_areas(geometry)
    edges = half_edges(corners, n)
    return laplacian_matrix(edges, cotangent_weights(edges, geometry), n)
