"""Mean value weights of a plane mesh, made positive where it is folded.

M. S. Floater, "Mean value coordinates", 2003: w_ij = (tan(alpha / 2) + tan(beta / 2)) / |ij| with the angles at i on
both sides of edge ij. A vertex in an unfolded star is exactly the mean of its neighbours by these weights; and where
all weights are positive and the boundary convex, the means of neighbours make an embedding (Tutte 1963; Floater,
"One-to-one piecewise linear mappings over triangulations", 2003). So solving with them moves what is folded, and the
rest only to make room.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array, diags_array
from scipy.sparse.linalg import splu

from ..errors import SolverError
from ..mesh.surface import Surface

__all__ = ["NeighbourMeans", "positive_mean_value_matrix", "surface_mean_value_matrix"]

LEAST_ANGLE = 0.005  # radians, of the corners at a vertex with a folded face
LEAST_RATIO = 0.01  # of the two edges of such a corner
SHORTEST = 1e-14  # distance of neighbours in the unit disk
NOWHERE = "Some vertices have no place between the others: the weights that tie them there are lost to rounding."
LEAST_PART = 1e-12  # of the longest edge, taken for edges that are shorter


def positive_mean_value_matrix(
    z: NDArray[np.complex128], corners: NDArray[np.int32], faces: NDArray[np.int64], folded: NDArray[np.bool_]
) -> csr_array:
    """Row i holds the weights w_ij of vertex i, from the given faces alone; not symmetric.

    Parameters
    ----------
    z : (n,) complex128
        Positions.
    corners : (3, m) int32
    faces : (k,) int64
        Faces to take; rows of vertices all of whose faces are among them are complete.
    folded : (n,) bool
        Vertices of folded faces. Their angles are taken without sign and kept away from 0 and 180 degrees.

    Returns
    -------
    (n, n) csr_array, no diagonal, entries positive.
    """
    here = corners.take(faces, axis=1)
    after, before = here[[1, 2, 0]], here[[2, 0, 1]]
    ahead, behind = z[after] - z[here], z[before] - z[here]
    angle = np.abs(np.angle(ahead.conj() * behind))
    loose = folded[here]
    angle[loose] = np.clip(angle[loose], LEAST_ANGLE, np.pi - LEAST_ANGLE)
    tangent = np.tan(np.clip(0.5 * angle, 1e-9, 0.5 * np.pi - 1e-9))
    rows = np.concatenate((here, here)).reshape(-1)
    columns = np.concatenate((after, before)).reshape(-1)
    reach = np.where(loose, LEAST_RATIO, 0.0) * (np.abs(ahead) + np.abs(behind)) + SHORTEST
    values = np.concatenate((tangent / np.maximum(np.abs(ahead), reach), tangent / np.maximum(np.abs(behind), reach)))
    return csr_array((values.reshape(-1), (rows, columns)), shape=(len(z), len(z)))


def surface_mean_value_matrix(surface: Surface) -> csr_array:
    """The same of the surface itself: rows complete at interior vertices, entries positive, (n, n)."""
    angle = np.arctan2(surface.geometry.double_area, surface.geometry.dot)
    tangent = np.tan(np.clip(0.5 * angle, 1e-9, 0.5 * np.pi - 1e-9))
    lengths = np.sqrt(np.maximum(surface.geometry.squared_lengths, 0.0))
    lengths = np.maximum(lengths, LEAST_PART * lengths.max())
    here, after, before = surface.corners, surface.corners[[1, 2, 0]], surface.corners[[2, 0, 1]]
    rows, columns = np.concatenate((here, here)), np.concatenate((after, before))
    values = np.concatenate((tangent / lengths, tangent / lengths[[2, 0, 1]]))
    return csr_array((values.reshape(-1), (rows.reshape(-1), columns.reshape(-1))), shape=(surface.n, surface.n))


class NeighbourMeans:
    """Vertices at the weighted means of their neighbours, factorized once.

    Parameters
    ----------
    weights : (n, n) csr_array
        Not negative; rows of the free vertices complete.
    free : (k,) int64
        The vertices to place; from each some path of positive weights leads to another vertex.

    Raises
    ------
    SolverError
        For doubles there is no such path.
    """

    def __init__(self, weights: csr_array, free: NDArray[np.int64]) -> None:
        self._free = free
        rows = weights[free]
        self._rows = csr_array(diags_array(1.0 / rows.sum(axis=1)) @ rows)
        system = csc_array(diags_array(np.ones(len(free))) - self._rows[:, free])
        options = {"SymmetricMode": True}
        if len(free):
            try:
                self._solver = splu(system, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
            except RuntimeError as error:
                raise SolverError(NOWHERE) from error

    def placed(self, z: NDArray[np.complex128]) -> NDArray[np.complex128]:
        """z (n,) with the free vertices where the others put them."""
        out = z.copy()
        if not len(self._free):
            return out
        out[self._free] = 0.0
        right = self._rows @ out
        solve = self._solver.solve
        out[self._free] = solve(np.ascontiguousarray(right.real)) + 1j * solve(np.ascontiguousarray(right.imag))
        if not np.isfinite(out).all():
            raise SolverError(NOWHERE)
        return out
