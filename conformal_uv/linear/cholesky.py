"""Factorizations of sparse symmetric positive definite matrices, by CHOLMOD (through cvxopt) and by scipy's SuperLU."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from ..errors import SolverError
from ..progress import Progress
from .cvxopt_options import cholmod_options
from .linear_system import LowerTriangle

__all__ = ["Cholmod", "SuperLU"]

EPS = float(np.finfo(np.float64).eps)
FAILURES = (ArithmeticError, MemoryError, RuntimeError, TypeError, ValueError)  # what the libraries raise
KEEP_ORDER = {"nmethods": 1}  # the given order, without trying others
MANY = 20_000  # unknowns, from which on sparse right-hand sides are the faster ones
SPARSE = 0.125  # of the unknowns, up to which a right-hand side is sparse


class Cholmod:
    """Supernodal Cholesky factorization by CHOLMOD. Symbolic and numeric work can not be interrupted."""

    backend = "cholmod"
    accuracy = EPS

    def __init__(self, matrix: LowerTriangle, progress: Progress, order: NDArray[np.int32] | None) -> None:
        from cvxopt import cholmod, spmatrix
        from cvxopt import matrix as dense

        self._order, given = order, {}
        if order is not None:  # neighbours in the order of elimination lie side by side in memory, too
            matrix, passing = matrix.reordered(order), matrix
            passing.taken_over()
            given = {"p": dense(np.arange(matrix.n))}
        columns = np.repeat(np.arange(matrix.n), np.diff(matrix.indptr))
        rows = matrix.indices.astype(np.int64)
        lower = spmatrix(dense(matrix.data), dense(rows), dense(columns), (matrix.n, matrix.n))
        del columns, rows
        matrix.taken_over()
        self._n, self._dense, self._sparse, self._cholmod = matrix.n, dense, spmatrix, cholmod
        try:
            with cholmod_options(**({} if order is None else KEEP_ORDER)):
                self._factor = cholmod.symbolic(lower, uplo="L", **given)
        except FAILURES as error:
            raise _failed(matrix.n, error) from error
        progress("factorization", 0.0)
        try:
            with cholmod_options():
                cholmod.numeric(lower, self._factor)
        except FAILURES as error:
            raise _failed(matrix.n, error) from error
        progress("factorization", 1.0)

    def solve(self, rhs: NDArray[np.float64]) -> NDArray[np.float64]:
        columns = self._dense((rhs if self._order is None else rhs.take(self._order, axis=0)).reshape(len(rhs), -1))
        try:
            with cholmod_options():
                self._cholmod.solve(self._factor, columns)
        except FAILURES as error:
            raise _failed(self._n, error) from error
        return self._restored(np.array(columns).reshape(rhs.shape))

    def solve_at(self, rows: NDArray[np.int64], values: NDArray[np.float64]) -> NDArray[np.float64]:
        """CHOLMOD takes the columns of a sparse right-hand side together, dense ones one after the other.

        That pays for many unknowns. For few it does not, and cvxopt's spsolve (1.3.3) loses some bytes at every call.
        It takes the rows one by one, and is slow where a good part of them has a value.
        """
        n, k = self._n, values.shape[1]
        if n < MANY or len(rows) > SPARSE * n:
            rhs = np.zeros((n, k))
            rhs[rows] = values
            return self.solve(rhs)
        if self._order is not None:
            rows = self._number.take(rows)
        columns = np.repeat(np.arange(k), len(rows))
        entries = self._dense(np.ascontiguousarray(values.T).reshape(-1))
        sparse = self._sparse(entries, self._dense(np.tile(rows, k)), self._dense(columns), (n, k))
        try:
            with cholmod_options():
                found = self._cholmod.spsolve(self._factor, sparse)
        except FAILURES as error:
            raise _failed(n, error) from error
        out = np.array(found.V).reshape(-1)
        if len(out) < n * k:  # entries that came out 0 are left out
            full = np.zeros(n * k)
            full[np.array(found.I).reshape(-1) + n * np.array(found.J).reshape(-1)] = out
            out = full
        return self._restored(out.reshape(k, n).T)

    @cached_property
    def _number(self) -> NDArray[np.int64]:
        """Place of each unknown in the order."""
        number = np.empty(self._n, dtype=np.int64)
        number[self._order] = np.arange(self._n)
        return number

    def _restored(self, solution: NDArray[np.float64]) -> NDArray[np.float64]:
        """A solution in the order of elimination, in the unknowns' own."""
        return solution if self._order is None else solution.take(self._number, axis=0)

    def report_to(self, progress: Progress) -> None:
        """Solutions are too fast to tell of."""


class SuperLU:
    """LU factorization by SuperLU in its symmetric mode, without pivoting. It can not be interrupted."""

    backend = "superlu"
    accuracy = EPS

    def __init__(self, matrix: LowerTriangle, progress: Progress, order: NDArray[np.int32] | None) -> None:
        n = matrix.n
        self._order = order
        column = np.repeat(np.arange(n, dtype=np.int32), np.diff(matrix.indptr))
        row = matrix.indices
        if order is not None:
            number = np.empty(n, dtype=np.int32)
            number[order] = np.arange(n, dtype=np.int32)
            row, column = number.take(row), number.take(column)
        strict = np.ones(len(matrix.data), dtype=bool)
        strict[matrix.indptr[:-1]] = False
        values = np.concatenate((matrix.data, matrix.data[strict]))
        places = np.concatenate((row, column[strict])), np.concatenate((column, row[strict]))
        full = csc_array((values, places), shape=(n, n))
        del row, column, strict, values, places
        matrix.taken_over()
        full.indices, full.indptr = full.indices.astype(np.int32), full.indptr.astype(np.int32)
        progress("factorization", 0.0)  # where SuperLU looks for the order itself, it does so in the same call
        try:
            self._factor = splu(
                full,
                permc_spec="MMD_AT_PLUS_A" if order is None else "NATURAL",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except FAILURES as error:
            raise _failed(n, error) from error
        progress("factorization", 1.0)

    def solve(self, rhs: NDArray[np.float64]) -> NDArray[np.float64]:
        if self._order is None:
            return self._factor.solve(rhs)
        out = np.empty_like(rhs)
        out[self._order] = self._factor.solve(rhs[self._order])
        return out

    def solve_at(self, rows: NDArray[np.int64], values: NDArray[np.float64]) -> NDArray[np.float64]:
        """As dense right-hand sides, which SuperLU takes together."""
        rhs = np.zeros((self._factor.shape[0], values.shape[1]))
        rhs[rows] = values
        return self.solve(rhs)

    def report_to(self, progress: Progress) -> None:
        """Solutions are too fast to tell of."""


def _failed(n: int, error: Exception) -> SolverError:
    if isinstance(error, MemoryError):
        return SolverError(
            f"There is not enough memory to factorize the Laplacian of {n} interior vertices; "
            'use backend="multigrid" (pip install "conformal-uv[large]"), or fewer vertices.'
        )
    return SolverError(
        f"The Laplacian of {n} interior vertices is singular to working precision ({error}); "
        "the mesh has faces too thin for it."
    )
