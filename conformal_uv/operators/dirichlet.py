"""The Dirichlet problem of a Laplacian, factorized once: harmonic extensions and boundary fluxes."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from ..errors import SolverError
from ..linear.backends import choose_backend, linear_solver
from ..linear.linear_system import LinearSolver, LowerTriangle
from ..linear.nested_dissection import nested_dissection
from ..progress import Progress
from .edge_laplacian import EdgeLaplacian
from .neumann_strip import NeumannStrip

__all__ = ["DirichletProblem", "interior_matrix"]

EPS = float(np.finfo(np.float64).eps)
FEW = 2000  # interior vertices, which the libraries order as fast
WIDE_SPREAD = 1e6  # of the largest weight over the median
# Largest and smallest weight over the median where weights spread so wide that Lii is singular in doubles: vertices
# joined by the largest then differ by 1e-10 (1e-6, 1e-3) of what sets them apart from their neighbours.
CAPS = ((1e10, 0.0), (1e6, 1e-6), (1e3, 1e-9))
CORRECTIONS = 2  # steps of iterative refinement where weights spread so wide


class DirichletProblem:
    """``Lii u_i = -Lib u_b`` for a Laplacian of weighted edges; i interior, b boundary in its order.

    Parameters
    ----------
    laplacian : EdgeLaplacian
        Lii must come out positive definite.
    boundary : (nb,) integers
        Vertices with given values.
    n : int
        Number of vertices.
    points : (n, d) float64, optional
        Positions of the vertices. They speed up the factorization: the order of elimination is read off them.
    backend : {"auto", "cholmod", "superlu", "multigrid"}
        The attribute of this name says what it came to.
    progress : Progress, optional

    Raises
    ------
    SolverError
        Lii is singular to working precision.
    """

    def __init__(
        self,
        laplacian: EdgeLaplacian,
        boundary: NDArray[np.int64],
        n: int,
        *,
        points: NDArray[np.float64] | None = None,
        backend: str = "auto",
        progress: Progress | None = None,
    ) -> None:
        progress = progress or Progress()
        self.n = n
        self.boundary = boundary
        inside, self.interior, number = _numbered(boundary, n)
        self.backend = choose_backend(backend)
        self._corrections = CORRECTIONS if _spread(laplacian.weights) > WIDE_SPREAD else 0
        self._solver: LinearSolver | None = None
        self.laplacian = laplacian
        for span in (*CAPS, None):
            self._degree = _degrees(self.laplacian, n)
            try:
                self._factorize(inside, number, points, backend, progress)
                break
            except SolverError:
                if span is None or (laplacian.weights[inside[laplacian.lo] | inside[laplacian.hi]] < 0.0).any():
                    raise
                self.laplacian = _capped(laplacian, *span)
        self._blocks(inside, number)

    def _factorize(
        self,
        inside: NDArray[np.bool_],
        number: NDArray[np.int32],
        points: NDArray[np.float64] | None,
        backend: str,
        progress: Progress,
    ) -> None:
        """Make Lii ready to be solved with."""
        if not len(self.interior):
            return
        matrix = _lower_triangle(self.laplacian, inside, number, self._degree[self.interior])
        progress("ordering", 0.0)
        order = None
        if points is not None and matrix.n > FEW:
            order = nested_dissection(points[self.interior], matrix.indices, matrix.indptr)
        matrix.passing = True
        self._solver = linear_solver(matrix, backend, progress, order)
        self.backend = self._solver.backend

    def _blocks(self, inside: NDArray[np.bool_], number: NDArray[np.int32]) -> None:
        """Lib and Lbb, a few entries for each boundary vertex."""
        lo, hi, weights = self.laplacian.lo, self.laplacian.hi, self.laplacian.weights
        touching = np.flatnonzero(~(inside[lo] & inside[hi]))
        i, j, w = lo[touching], hi[touching], weights[touching]
        mixed = inside[i] | inside[j]
        swap = inside[j]
        a, b = np.where(swap, j, i)[mixed], np.where(swap, i, j)[mixed]
        ni, nb = len(self.interior), len(self.boundary)
        self.Lib = csr_array((-w[mixed], (number[a], number[b])), shape=(ni, nb))
        self.Lbi = self.Lib.T.tocsr()
        self._near = np.flatnonzero(np.diff(self.Lib.indptr)).astype(np.int64)  # rows that are not empty
        self._next_to_boundary = self.Lib[self._near]
        i, j, w = number[i[~mixed]], number[j[~mixed]], -w[~mixed]
        d = np.arange(nb)
        values = np.concatenate((w, w, self._degree[self.boundary]))
        self.Lbb = csr_array((values, (np.concatenate((i, j, d)), np.concatenate((j, i, d)))), shape=(nb, nb))

    @property
    def accuracy(self) -> float:
        """Relative error of a solution; rounding, where there is a factorization."""
        return EPS if self._solver is None else self._solver.accuracy

    @cached_property
    def boundary_inverse(self) -> NeumannStrip:
        """About the inverse of what `flux` applies to boundary values: a preconditioner."""
        backend = "auto" if self.backend == "multigrid" else self.backend
        return NeumannStrip(self.laplacian, self.boundary, self.n, backend)

    def report_to(self, progress: Progress) -> None:
        """Where solutions that take long are to report from now on."""
        if self._solver is not None:
            self._solver.report_to(progress)

    def solve(self, rhs: NDArray[np.float64]) -> NDArray[np.float64]:
        """``Lii^-1 rhs`` for rhs (ni,) or (ni, k).

        Very large weights (of mollified slivers) drown the small ones in the sums on the diagonal; the residual, taken
        over differences along edges, still has them, and corrects the solution.
        """
        if self._solver is None:
            return rhs.copy()
        x = self._solver.solve(rhs)
        for _ in range(self._corrections):
            x = x + self._solver.solve(rhs - self._apply(x))
        return x

    def _apply(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        """``Lii x``, as weighted differences along the edges."""
        full = np.zeros((self.n, *x.shape[1:]))
        full[self.interior] = x
        lo, hi = self.laplacian.lo, self.laplacian.hi
        flow = (self.laplacian.weights * (full[lo] - full[hi]).T).T
        columns = flow.reshape(len(lo), -1).T
        out = [
            np.bincount(lo, weights=column, minlength=self.n) - np.bincount(hi, weights=column, minlength=self.n)
            for column in columns
        ]
        return np.stack(out, axis=1)[self.interior].reshape(x.shape)

    def interior_values(self, zb: NDArray[np.complex128]) -> NDArray[np.complex128]:
        """Harmonic extension of complex boundary values zb (nb,), at the interior vertices (ni,)."""
        values = -(self._next_to_boundary @ zb.view(np.float64).reshape(-1, 2))
        if self._solver is None or self._corrections:
            rhs = np.zeros((len(self.interior), 2))
            rhs[self._near] = values
            found = self.solve(rhs)
        else:
            found = self._solver.solve_at(self._near, values)
        z = np.empty(len(found), dtype=np.complex128)
        z.real, z.imag = found.T
        return z

    def extend(self, zb: NDArray[np.complex128]) -> NDArray[np.complex128]:
        """Harmonic extension of complex boundary values zb (nb,) to all vertices (n,)."""
        z = np.empty(self.n, dtype=np.complex128)
        z[self.boundary] = zb
        z[self.interior] = self.interior_values(zb)
        return z

    def flux(self, zb: NDArray[np.complex128], interior: NDArray[np.complex128]) -> NDArray[np.complex128]:
        """``S zb``, S = Lbb - Lbi Lii^-1 Lib: outward flux (nb,) of the extension with these interior values."""
        return self.Lbb @ zb + self.Lbi @ interior

    def harmonic_measure(self, vertex: int) -> NDArray[np.float64]:
        """Harmonic measure of the boundary vertices seen from an interior vertex, (nb,); it sums to 1.

        The flux of the Green's function with its pole at the vertex.
        """
        return self.mean_measure(np.array([vertex]), np.ones(1))

    def mean_measure(self, vertices: NDArray[np.int64], weights: NDArray[np.float64]) -> NDArray[np.float64]:
        """The weighted sum of the harmonic measures seen from some interior vertices, (nb,): what boundary values have
        to be multiplied by to give the weighted sum of their extension there."""
        pole = np.zeros(len(self.interior))
        pole[np.searchsorted(self.interior, vertices)] = weights
        return -(self.Lbi @ self.solve(pole))


def interior_matrix(laplacian: EdgeLaplacian, boundary: NDArray[np.int64], n: int) -> LowerTriangle:
    """Lii: rows and columns of the vertices that are not on the boundary, in their order."""
    inside, interior, number = _numbered(boundary, n)
    return _lower_triangle(laplacian, inside, number, _degrees(laplacian, n)[interior])


def _lower_triangle(
    laplacian: EdgeLaplacian, inside: NDArray[np.bool_], number: NDArray[np.int32], diagonal: NDArray[np.float64]
) -> LowerTriangle:
    """The same. Sorted edges already stand in the order of its columns."""
    lo, hi, weights = laplacian.lo, laplacian.hi, laplacian.weights
    both = np.flatnonzero(inside.take(lo) & inside.take(hi))
    column, row = number.take(lo.take(both)), number.take(hi.take(both))
    ni = len(diagonal)
    indptr = np.zeros(ni + 1, dtype=np.int64)
    np.cumsum(np.bincount(column, minlength=ni) + 1, out=indptr[1:])
    data = np.empty(indptr[-1])
    indices = np.empty(indptr[-1], dtype=np.int32)
    place = np.arange(1, len(both) + 1)
    place += column
    data[place], indices[place] = -weights.take(both), row
    data[indptr[:-1]] = diagonal
    indices[indptr[:-1]] = np.arange(ni, dtype=np.int32)
    return LowerTriangle(data, indices, indptr)


def _numbered(boundary: NDArray[np.int64], n: int) -> tuple[NDArray[np.bool_], NDArray[np.int64], NDArray[np.int32]]:
    """Which vertices are interior, the list of them, and each vertex's place within the interior or the boundary."""
    inside = np.ones(n, dtype=bool)
    inside[boundary] = False
    interior = np.flatnonzero(inside)
    number = np.empty(n, dtype=np.int32)
    number[interior] = np.arange(len(interior), dtype=np.int32)
    number[boundary] = np.arange(len(boundary), dtype=np.int32)
    return inside, interior, number


def _spread(weights: NDArray[np.float64]) -> float:
    """The largest weight over the median of the positive ones, taken from some thousands of them."""
    some = weights[:: len(weights) // 8192 + 1]
    some = some[some > 0.0]
    return float(weights.max() / np.median(some)) if len(some) else 0.0


def _capped(laplacian: EdgeLaplacian, most: float, least: float) -> EdgeLaplacian:
    """The Laplacian with weights between so much and so little of the median of the positive ones."""
    weights = laplacian.weights
    typical = float(np.median(weights[weights > 0.0]))
    return replace(laplacian, weights=np.clip(weights, np.minimum(weights, 0.0) + least * typical, most * typical))


def _degrees(laplacian: EdgeLaplacian, n: int) -> NDArray[np.float64]:
    """Sum of the weights around each vertex, (n,)."""
    lower = np.bincount(laplacian.lo, laplacian.weights, n).astype(np.float64, copy=False)
    return lower + np.bincount(laplacian.hi, laplacian.weights, n)
