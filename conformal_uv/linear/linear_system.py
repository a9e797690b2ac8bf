"""Sparse symmetric positive definite systems, and what every way of solving them offers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from ..progress import Progress

__all__ = ["LinearSolver", "LowerTriangle"]


@dataclass(eq=False)
class LowerTriangle:
    """The lower triangle of a symmetric (n, n) matrix in CSC form, rows sorted, diagonal first.

    Attributes
    ----------
    data, indices, indptr
    passing : bool
        Nobody else needs it: a solver that has made its own form of it may let the arrays go.
    """

    data: NDArray[np.float64]
    indices: NDArray[np.int32]
    indptr: NDArray[np.int64]
    passing: bool = False

    def __post_init__(self) -> None:
        self._n = len(self.indptr) - 1

    @property
    def n(self) -> int:
        """Order of the matrix."""
        return self._n

    def reordered(self, order: NDArray[np.int32]) -> LowerTriangle:
        """The matrix of the unknowns in another order, the first of which is ``order[0]``."""
        n = self.n
        number = np.empty(n, dtype=np.int32)
        number[order] = np.arange(n, dtype=np.int32)
        row, column = number.take(self.indices), np.repeat(number, np.diff(self.indptr))
        ends = np.maximum(row, column), np.minimum(row, column)
        found = csc_array((self.data, ends), shape=(n, n))
        found.sort_indices()
        return LowerTriangle(found.data, found.indices, found.indptr, passing=True)

    def taken_over(self) -> None:
        """Called by a solver that does not need the arrays any more."""
        if self.passing:
            self.data, self.indices, self.indptr = self.data[:0].copy(), self.indices[:0].copy(), self.indptr[:1].copy()


class LinearSolver(Protocol):
    """A matrix made ready to be solved with."""

    backend: str
    accuracy: float  # of a solution, relatively, in the energy norm

    def solve(self, rhs: NDArray[np.float64]) -> NDArray[np.float64]:
        """Solution for right-hand sides (n,) or (n, k)."""
        ...

    def solve_at(self, rows: NDArray[np.int64], values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Solution (n, k) for right-hand sides with these values (r, k) in some rows and 0 in the others."""
        ...

    def report_to(self, progress: Progress) -> None:
        """Where solutions that take long are to report from now on."""
        ...
