"""Factorizations of sparse symmetric positive definite matrices.

CHOLMOD (through cvxopt, supernodal) where it is installed, else scipy's SuperLU in symmetric mode.
"""

from __future__ import annotations

import importlib.util
import os
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from ..errors import MissingDependencyError, OptionError, SolverError
from ..progress import Progress

__all__ = ["BACKENDS", "Factorization", "LowerTriangle", "choose_backend", "factorize"]

BACKENDS = ("cholmod", "superlu")
ENVIRONMENT_VARIABLE = "CONFORMAL_UV_BACKEND"


@dataclass(frozen=True, eq=False)
class LowerTriangle:
    """The lower triangle of a symmetric (n, n) matrix in CSC form, rows sorted, diagonal first."""

    data: NDArray[np.float64]
    indices: NDArray[np.int32]
    indptr: NDArray[np.int64]

    @property
    def n(self) -> int:
        """Order of the matrix."""
        return len(self.indptr) - 1


class Factorization(Protocol):
    """A factorized matrix."""

    backend: str

    def solve(self, rhs: NDArray[np.float64]) -> NDArray[np.float64]:
        """Solution for right-hand sides (n,) or (n, k)."""
        ...


def choose_backend(backend: str = "auto") -> str:
    """Name of the factorization library to use.

    "auto" takes what the environment variable CONFORMAL_UV_BACKEND names, else CHOLMOD where it is installed,
    else SuperLU.

    Raises
    ------
    OptionError
        An unknown name.
    MissingDependencyError
        "cholmod" without cvxopt.
    """
    name = backend
    if name == "auto":
        name = os.environ.get(ENVIRONMENT_VARIABLE, "").strip().lower() or "auto"
    available = importlib.util.find_spec("cvxopt") is not None
    if name == "auto":
        return "cholmod" if available else "superlu"
    if name not in BACKENDS:
        raise OptionError(f"Unknown backend {name!r}; choose auto, {' or '.join(BACKENDS)}.")
    if name == "cholmod" and not available:
        raise MissingDependencyError('The backend "cholmod" needs cvxopt: pip install cvxopt, or use "superlu".')
    return name


def factorize(
    matrix: LowerTriangle,
    backend: str = "auto",
    progress: Progress | None = None,
    order: NDArray[np.int32] | None = None,
) -> Factorization:
    """Factorize a symmetric positive definite matrix.

    Parameters
    ----------
    matrix : LowerTriangle
    backend : {"auto", "cholmod", "superlu"}
    order : (n,) int32, optional
        In which to eliminate the unknowns; by default the library looks for one (CHOLMOD by approximate minimum
        degree, SuperLU by multiple minimum degree).

    Raises
    ------
    SolverError
        The matrix is singular to working precision.
    """
    progress = progress or Progress()
    name = choose_backend(backend)
    return (_Cholmod if name == "cholmod" else _SuperLU)(matrix, progress, order)


class _Cholmod:
    backend = "cholmod"

    def __init__(self, matrix: LowerTriangle, progress: Progress, order: NDArray[np.int32] | None) -> None:
        from cvxopt import cholmod, spmatrix
        from cvxopt import matrix as dense

        columns = np.repeat(np.arange(matrix.n), np.diff(matrix.indptr))
        rows = matrix.indices.astype(np.int64)
        lower = spmatrix(dense(matrix.data), dense(rows), dense(columns), (matrix.n, matrix.n))
        del columns, rows
        self._dense, self._cholmod = dense, cholmod
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


class _SuperLU:
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


def _singular(n: int, error: Exception) -> SolverError:
    return SolverError(
        f"The Laplacian of {n} interior vertices is singular to working precision ({error}); "
        "the mesh has faces too thin for it."
    )
