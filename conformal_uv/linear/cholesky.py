"""Factorizations of sparse symmetric positive definite matrices, by CHOLMOD (through cvxopt) and by scipy's SuperLU."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from ..errors import SolverError
from ..progress import Progress
from .linear_system import LowerTriangle

__all__ = ["Cholmod", "SuperLU"]


class Cholmod:
    """Supernodal Cholesky factorization by CHOLMOD. Symbolic and numeric work can not be interrupted."""

    backend = "cholmod"

    def __init__(self, matrix: LowerTriangle, progress: Progress, order: NDArray[np.int32] | None) -> None:
        from cvxopt import cholmod, spmatrix
        from cvxopt import matrix as dense

        columns = np.repeat(np.arange(matrix.n), np.diff(matrix.indptr))
        rows = matrix.indices.astype(np.int64)
        lower = spmatrix(dense(matrix.data), dense(rows), dense(columns), (matrix.n, matrix.n))
        del columns, rows
        matrix.taken_over()
        self._n, self._dense, self._sparse, self._cholmod = matrix.n, dense, spmatrix, cholmod
        if order is None:
            self._factor = cholmod.symbolic(lower, uplo="L")
        else:
            methods = cholmod.options.get("nmethods", 0)
            cholmod.options["nmethods"] = 1  # the given order, without trying others
            try:
                self._factor = cholmod.symbolic(lower, p=dense(order.astype(np.int64)), uplo="L")
            finally:
                cholmod.options["nmethods"] = methods
        progress("factorization", 0.0)
        try:
            cholmod.numeric(lower, self._factor)
        except ArithmeticError as error:
            raise _singular(matrix.n, error) from error
        progress("factorization", 1.0)

    def solve(self, rhs: NDArray[np.float64]) -> NDArray[np.float64]:
        columns = self._dense(rhs.reshape(len(rhs), -1))
        self._cholmod.solve(self._factor, columns)
        return np.array(columns).reshape(rhs.shape)

    def solve_at(self, rows: NDArray[np.int64], values: NDArray[np.float64]) -> NDArray[np.float64]:
        """CHOLMOD takes the columns of a sparse right-hand side together, dense ones one after the other."""
        n, k = self._n, values.shape[1]
        columns = np.repeat(np.arange(k), len(rows))
        entries = self._dense(np.ascontiguousarray(values.T).reshape(-1))
        sparse = self._sparse(entries, self._dense(np.tile(rows, k)), self._dense(columns), (n, k))
        found = self._cholmod.spsolve(self._factor, sparse)
        out = np.array(found.V).reshape(-1)
        if len(out) < n * k:  # entries that came out 0 are left out
            full = np.zeros(n * k)
            full[np.array(found.I).reshape(-1) + n * np.array(found.J).reshape(-1)] = out
            out = full
        return out.reshape(k, n).T

    def report_to(self, progress: Progress) -> None:
        """Solutions are too fast to tell of."""


class SuperLU:
    """LU factorization by SuperLU in its symmetric mode, without pivoting. It can not be interrupted."""

    backend = "superlu"

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
        except RuntimeError as error:
            raise _singular(n, error) from error
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


def _singular(n: int, error: Exception) -> SolverError:
    return SolverError(
        f"The Laplacian of {n} interior vertices is singular to working precision ({error}); "
        "the mesh has faces too thin for it."
    )
