"""Sparse symmetric positive definite systems, and what every way of solving them offers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..progress import Progress

__all__ = ["LinearSolver", "LowerTriangle"]


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


class LinearSolver(Protocol):
    """A matrix made ready to be solved with."""

    backend: str

    def solve(self, rhs: NDArray[np.float64]) -> NDArray[np.float64]:
        """Solution for right-hand sides (n,) or (n, k)."""
        ...

    def solve_at(self, rows: NDArray[np.int64], values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Solution (n, k) for right-hand sides with these values (r, k) in some rows and 0 in the others."""
        ...

    def report_to(self, progress: Progress) -> None:
        """Where solutions that take long are to report from now on."""
        ...
