"""Conjugate gradients preconditioned by algebraic multigrid, for meshes whose factor does not fit into memory.

The hierarchy and the iteration are pyamg's: J. Ruge, K. Stueben, "Algebraic multigrid", 1987, with the second pass of
the coarsening, and one V-cycle as preconditioner, Gauss-Seidel forward before and backward after the coarse correction,
so that it is symmetric. From 10k to 1M vertices it takes 11 to 15 steps; without the second pass steps grow with the
mesh, and smoothed aggregation takes two to ten times as many where triangles are thin. The hierarchy is kept in single
precision, which costs no steps.
"""

from __future__ import annotations

import importlib.util
import logging
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.linalg import LinearOperator

from ..errors import MissingDependencyError, SolverError
from ..progress import Progress
from .linear_system import LowerTriangle

if TYPE_CHECKING:
    from pyamg.multilevel import MultilevelSolver

__all__ = ["Multigrid", "require_pyamg"]

Real = NDArray[np.float64]
log = logging.getLogger(__name__)

TOLERANCE = 1e-12  # of the energy norm of the error, over that of the solution
ROUNDING = 4.0 * float(np.finfo(np.float64).eps)  # times sqrt(n), ten times the error at which steps gain no more
SUFFICIENT = 1e-10  # where thin faces let rounding stop the steps before the tolerance
MOST_STEPS = 300
PRECISION = np.float32  # of the hierarchy
COARSEST = 500  # unknowns that are solved for directly


def require_pyamg() -> None:
    """Raise MissingDependencyError where pyamg is not installed."""
    if importlib.util.find_spec("pyamg") is None:
        raise MissingDependencyError(
            'The backend "multigrid" needs pyamg: pip install "conformal-uv[large]", or use another backend.'
        )


class Multigrid:
    """Solutions of one symmetric positive definite system, to about 1e-12 in the energy norm, relatively.

    That norm is the Dirichlet norm of the error, which bounds what the maps read off a solution: values in the
    interior, and sums of fluxes along any stretch of the boundary, both up to the square root of a logarithm of n.

    Parameters
    ----------
    matrix : LowerTriangle
    progress : Progress
        Told of every step, as the stage "conjugate gradients"; a step is as far as a cancel has to wait.

    Attributes
    ----------
    steps : int
        Of the last solution, over all its right-hand sides.

    Raises
    ------
    MissingDependencyError
        Without pyamg.
    """

    backend = "multigrid"
    accuracy = TOLERANCE

    def __init__(self, matrix: LowerTriangle, progress: Progress) -> None:
        require_pyamg()
        self._progress = progress
        self.steps = 0
        progress("factorization", 0.0)
        self._matrix = _full(matrix)
        matrix.taken_over()
        try:
            self._hierarchy = _hierarchy(self._matrix)
        except (ArithmeticError, MemoryError, RuntimeError, TypeError, ValueError) as error:
            raise self._failed(f"The multigrid hierarchy can not be built ({error})") from error
        progress("factorization", 1.0)

    def solve(self, rhs: Real) -> Real:
        """Solution for right-hand sides (n,) or (n, k), one after the other.

        Raises
        ------
        SolverError
            The iteration does not converge, or the matrix is not positive definite.
        CancelledError
            The user's callback returned False.
        """
        self.steps = 0
        columns = rhs.reshape(len(rhs), -1)
        out = np.empty_like(columns)
        for k, column in enumerate(columns.T):
            out[:, k] = self._solved(np.ascontiguousarray(column), k, columns.shape[1])
        return out.reshape(rhs.shape)

    def solve_at(self, rows: NDArray[np.int64], values: Real) -> Real:
        """Solution (n, k) for right-hand sides with these values (r, k) in some rows and 0 in the others."""
        rhs = np.zeros((self._matrix.shape[0], values.shape[1]))
        rhs[rows] = values
        return self.solve(rhs)

    def report_to(self, progress: Progress) -> None:
        """Where to report from now on."""
        self._progress = progress

    def _solved(self, rhs: Real, k: int, count: int) -> Real:
        """Solution for right-hand side k of `count`."""
        from pyamg.krylov import cg

        if not rhs.any():
            return np.zeros_like(rhs)
        first = energy = float(rhs @ self._cycle(rhs))  # of the solution, as the preconditioner sees it
        if not first > 0.0:
            raise self._failed("The Laplacian is not positive definite to working precision")

        def precondition(residual: Real) -> Real:
            nonlocal energy
            smooth = self._cycle(residual)
            energy = float(residual @ smooth)
            return smooth

        def watch(_: Real) -> None:
            self.steps += 1
            self._progress("conjugate gradients", (k + _fraction(energy, first)) / count)

        n = len(rhs)
        x, info = cg(
            self._matrix,
            rhs,
            tol=max(TOLERANCE, ROUNDING * np.sqrt(n)) * np.sqrt(first),
            criteria="rMr",
            maxiter=MOST_STEPS,
            M=LinearOperator((n, n), precondition, dtype=np.float64),
            callback=watch,
        )
        error = np.sqrt(energy / first) if energy > 0.0 else np.inf
        if info != 0 and not error <= SUFFICIENT:
            raise self._failed(f"The iteration stopped after {self.steps} steps at a relative error of {error:.1e}")
        log.debug("%d steps of conjugate gradients for %d unknowns", self.steps, n)
        return x

    def _cycle(self, residual: Real) -> Real:
        """One V-cycle in the precision of the hierarchy."""
        size = float(np.abs(residual).max()) or 1.0
        scaled = (residual / size).astype(PRECISION)
        try:
            smooth = self._hierarchy.solve(scaled, maxiter=1, tol=0.0, cycle="V").astype(np.float64)
        except RuntimeError as error:  # of SuperLU on the coarsest level
            raise self._failed(f"The Laplacian is singular to working precision ({error})") from error
        smooth *= size
        return smooth

    def _failed(self, what: str) -> SolverError:
        return SolverError(
            f"{what}, for {self._matrix.shape[0]} interior vertices; the mesh has faces too thin for this backend. "
            'Use "cholmod" or "superlu", or remove slivers.'
        )


def _full(lower: LowerTriangle) -> csr_array:
    """The whole matrix, in the row form and the short indices that pyamg takes."""
    data = lower.data.copy()
    data[lower.indptr[:-1]] *= 0.5
    upper = csr_array((data, lower.indices, lower.indptr.astype(np.int32)), shape=(lower.n, lower.n))
    full = upper + upper.T.tocsr()
    full.sort_indices()
    return full


def _hierarchy(matrix: csr_array) -> MultilevelSolver:
    from pyamg import ruge_stuben_solver

    rounded = csr_array((matrix.data.astype(PRECISION), matrix.indices, matrix.indptr), shape=matrix.shape)
    return ruge_stuben_solver(
        rounded,
        CF=("RS", {"second_pass": True}),
        presmoother=("gauss_seidel", {"sweep": "forward"}),
        postsmoother=("gauss_seidel", {"sweep": "backward"}),
        max_coarse=COARSEST,
        coarse_solver="splu",
    )


def _fraction(energy: float, first: float) -> float:
    """How far the logarithm of the error has come to that of the tolerance."""
    if not 0.0 < energy < first:
        return 0.0 if energy > 0.0 else 1.0
    return min(float(np.log(first / energy) / (-2.0 * np.log(TOLERANCE))), 1.0)
