"""The conformal energy of maps to the plane as one Hermitian matrix: E(z) = 1/2 z* H z, H = L + i D.

L is the Laplacian, 1/2 z* L z the Dirichlet energy. The signed area of the image is -1/2 z* i D z, with
D_jk = 1/2 for a side of the boundary from j to k and -1/2 for one from k to j. (U. Pinkall, K. Polthier 1993; that it
is the energy of least squares conformal maps: P. Mullen, Y. Tong, P. Alliez, M. Desbrun 2008, section 2.)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array

from ..errors import SolverError
from ..linear.backends import linear_solver
from ..linear.linear_system import LowerTriangle
from ..linear.nested_dissection import nested_dissection
from ..mesh.surface import Surface
from ..operators.edge_laplacian import EdgeLaplacian
from ..progress import Progress

__all__ = ["HeldConformal", "conformal_matrix"]

Complex = NDArray[np.complex128]
FEW = 2000  # unknowns, which the libraries order as fast
ENOUGH = 1e-9  # part of a right-hand side that a solution may leave; farther off the matrix is singular in doubles
CORRECTIONS = 3  # steps of iterative refinement at most
ROUNDING = 1e-14


def conformal_matrix(surface: Surface, laplacian: EdgeLaplacian) -> csr_array:
    """H, (n, n), complex."""
    lo, hi, w = laplacian.lo, laplacian.hi, laplacian.weights.astype(np.complex128)
    tail = np.concatenate(surface.loops)
    head = np.concatenate([np.roll(loop, -1) for loop in surface.loops])
    half = np.full(len(tail), 0.5j)
    rows = np.concatenate((lo, hi, lo, hi, tail, head))
    columns = np.concatenate((hi, lo, lo, hi, head, tail))
    values = np.concatenate((-w, -w, w, w, half, -half))
    return csr_array((values, (rows, columns)), shape=(surface.n, surface.n))


class HeldConformal:
    """The matrix with some vertices held, factorized: what least energy makes of all others.

    Parameters
    ----------
    surface : Surface
        One piece, with a boundary.
    laplacian : EdgeLaplacian
    held : (p,) int64
        At least two different vertices.
    backend : str
    progress : Progress

    Raises
    ------
    SolverError
        The matrix is singular to working precision.
    """

    def __init__(
        self, surface: Surface, laplacian: EdgeLaplacian, held: NDArray[np.int64], backend: str, progress: Progress
    ) -> None:
        self._held = held
        free = np.ones(surface.n, dtype=bool)
        free[held] = False
        self._free = np.flatnonzero(free)
        rows = conformal_matrix(surface, laplacian)[self._free]
        self._inside = rows[:, self._free].tocsr()
        self._across = rows[:, held].tocsr()
        matrix = _real_lower_triangle(self._inside)
        progress("ordering", 0.0)
        order = None
        if matrix.n > FEW:
            order = nested_dissection(np.repeat(surface.V[self._free], 2, axis=0), matrix.indices, matrix.indptr)
        matrix.passing = True
        self._solver = linear_solver(matrix, backend, progress, order) if len(self._free) else None
        self.backend = backend if self._solver is None else self._solver.backend

    def extended(self, values: Complex) -> Complex:
        """Positions of all vertices (n,) of least energy, with these (p,) where they are held.

        Raises
        ------
        SolverError
            Rounding leaves nothing of the solution.
        """
        z = np.empty(len(self._free) + len(self._held), dtype=np.complex128)
        z[self._held] = values
        rhs = -(self._across @ values)
        x = self._solve(rhs)
        size = float(np.abs(rhs).max(initial=0.0))
        for _ in range(CORRECTIONS):
            rest = rhs - self._inside @ x
            left = float(np.abs(rest).max(initial=0.0))
            if not left > ROUNDING * size:
                break
            x = x + self._solve(rest)
        if not np.isfinite(x).all() or np.abs(rhs - self._inside @ x).max(initial=0.0) > ENOUGH * size:
            raise SolverError(
                "The positions of the pins do not fix the map in doubles; pin vertices that lie farther apart."
            )
        z[self._free] = x
        return z

    def _solve(self, rhs: Complex) -> Complex:
        if self._solver is None:
            return rhs.copy()
        real = np.ascontiguousarray(rhs).view(np.float64)
        return np.ascontiguousarray(self._solver.solve(real)).view(np.complex128)


def _real_lower_triangle(matrix: csr_array) -> LowerTriangle:
    """A Hermitian matrix (n, n) as the symmetric one (2 n, 2 n) of real and imaginary parts in turn."""
    entries = matrix.tocoo()
    i, j, h = entries.row.astype(np.int64), entries.col.astype(np.int64), entries.data
    rows = np.concatenate((2 * i, 2 * i + 1, 2 * i, 2 * i + 1))
    columns = np.concatenate((2 * j, 2 * j + 1, 2 * j + 1, 2 * j))
    values = np.concatenate((h.real, h.real, -h.imag, h.imag))
    kept = (rows >= columns) & ((values != 0.0) | (rows == columns))
    n = 2 * matrix.shape[0]
    lower = csc_array((values[kept], (rows[kept], columns[kept])), shape=(n, n))
    lower.sort_indices()
    return LowerTriangle(lower.data, lower.indices.astype(np.int32), lower.indptr.astype(np.int64))
