"""Mean value weights: positive, whatever the triangles are like.

M. S. Floater, "Mean value coordinates", 2003: w_ij = (tan(alpha / 2) + tan(beta / 2)) / |ij| with the angles at i on
both sides of edge ij. They reproduce linear functions on flat stars, so they are nearly conformal, and any positive
weights with a convex boundary give an embedding (Tutte 1963; Floater 2003, "One-to-one piecewise linear mappings").
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from ..mesh.geometry import TriangleGeometry

__all__ = ["mean_value_matrix"]

EPS = np.finfo(np.float64).eps


def mean_value_matrix(
    corners: NDArray[np.int32], geometry: TriangleGeometry, n: int, faces: NDArray[np.int64]
) -> csr_array:
    """Row i holds the weights w_ij of vertex i, from the given faces alone; not symmetric.

    Parameters
    ----------
    corners : (3, m) int32
    geometry : TriangleGeometry
    n : int
        Number of vertices.
    faces : (k,) int64
        Faces to take; rows of vertices all of whose faces are among them are complete.

    Returns
    -------
    (n, n) csr_array, no diagonal, entries positive.
    """
    dot = geometry.dot[:, faces]
    squared = np.maximum(geometry.squared_lengths[:, faces], 0.0)
    longest = squared.max(axis=0, initial=np.finfo(np.float64).tiny)
    area2 = np.maximum(geometry.double_area[faces], EPS * longest)  # nothing is divided by 0
    length = np.sqrt(np.maximum(squared, EPS * EPS * longest))
    product = length * length[[2, 0, 1]]  # of the two edges at each corner
    # tan(angle / 2) = sin / (1 + cos) = (1 - cos) / sin, the one without cancellation
    obtuse = dot < 0.0
    tangent = np.where(obtuse, product - dot, area2) / np.where(obtuse, area2, product + dot)
    here, after, before = corners[:, faces], corners[[1, 2, 0]][:, faces], corners[[2, 0, 1]][:, faces]
    rows = np.concatenate((here, here)).reshape(-1)
    columns = np.concatenate((after, before)).reshape(-1)
    values = np.concatenate((tangent / length, tangent / length[[2, 0, 1]])).reshape(-1)
    return csr_array((values, (rows, columns)), shape=(n, n))
