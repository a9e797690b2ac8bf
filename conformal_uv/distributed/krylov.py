"""One sparse symmetric positive definite system over all ranks, solved by PETSc."""

from __future__ import annotations

import logging
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import MissingDependencyError, SolverError
from ..options import DistributedSolver
from .ranks import Ranks

__all__ = ["KrylovSystem", "require_petsc"]

Real = NDArray[np.float64]
log = logging.getLogger(__name__)

TOLERANCE = 1e-12  # of the residual, against the right-hand side
MOST_STEPS = 1000
# Smoothed aggregation. Edges with next to no weight are left out of aggregates, and four smoothings: a scan's 149 steps
# become 42. Aggregates of neighbours alone (square_graph 0) take 28, and in several processes twice the memory.
GAMG = {
    "pc_gamg_type": "agg",
    "pc_gamg_agg_nsmooths": "1",
    "pc_gamg_threshold": "0.05",
    "mg_levels_ksp_max_it": "4",
}
HYPRE = {"pc_hypre_boomeramg_coarsen_type": "HMIS", "pc_hypre_boomeramg_interp_type": "ext+i"}
MUMPS = {"mat_mumps_icntl_14": "50"}
PREFIX = "conformal_uv_"


def require_petsc() -> Any:
    """The module petsc4py.PETSc.

    Raises
    ------
    MissingDependencyError
    """
    try:
        from petsc4py import PETSc
    except ImportError as error:
        raise MissingDependencyError(
            'The backend "petsc" needs petsc4py and mpi4py: pip install "conformal-uv[mpi]", or those of conda or of '
            "the system (see docs/scale.md)."
        ) from error
    return PETSc


class KrylovSystem:
    """Rows of a matrix that this rank owns, the unknowns numbered over the ranks in order.

    Parameters
    ----------
    indptr, columns, data : arrays
        CSR; columns are numbers of unknowns of any rank.
    solver : {"gamg", "hypre", "mumps"}
        Conjugate gradients with algebraic multigrid, PETSc's or BoomerAMG, or a distributed factorization. Options of
        PETSc with the prefix ``conformal_uv_`` go before ours.

    Attributes
    ----------
    steps : list of int
        Of the conjugate gradients, solution by solution.

    Raises
    ------
    SolverError
        PETSc could not set it up.
    """

    def __init__(
        self,
        ranks: Ranks,
        indptr: NDArray[np.integer],
        columns: NDArray[np.integer],
        data: Real,
        solver: DistributedSolver = DistributedSolver.AUTO,
    ) -> None:
        self._petsc = PETSc = require_petsc()
        self._ranks, self.solver = ranks, _chosen(PETSc, solver)
        self.steps: list[int] = []
        self._direct = self.solver is DistributedSolver.MUMPS
        own = len(indptr) - 1
        kind = PETSc.IntType
        csr = indptr.astype(kind, copy=False), columns.astype(kind, copy=False), data
        self._matrix = PETSc.Mat().createAIJ(((own, None), (own, None)), csr=csr, comm=ranks.comm)
        self._matrix.setOption(PETSc.Mat.Option.SPD, True)
        self._x, self._rhs = self._matrix.createVecs()
        self._given = PETSc.Options()
        self._ours: list[str] = []
        self._ksp = PETSc.KSP().create(ranks.comm)
        self._ksp.setOptionsPrefix(PREFIX)
        self._ksp.setOperators(self._matrix)
        self._configure()
        try:
            self._ksp.setFromOptions()
            self._ksp.setUp()
        except PETSc.Error as error:
            raise SolverError(
                f"PETSc can not prepare {self.solver}: {_reason(error)}. Choose another solver."
            ) from error
        finally:
            for name in self._ours:
                self._given.delValue(name)

    def _configure(self) -> None:
        ksp, pc = self._ksp, self._ksp.getPC()
        if self._direct:
            ksp.setType("preonly")
            pc.setType("cholesky")
            pc.setFactorSolverType("mumps")
            self._default(MUMPS)
            return
        ksp.setType("cg")
        ksp.setNormType(self._petsc.KSP.NormType.UNPRECONDITIONED)
        ksp.setTolerances(rtol=TOLERANCE, atol=0.0, max_it=MOST_STEPS)
        if self.solver is DistributedSolver.HYPRE:
            pc.setType("hypre")
            pc.setHYPREType("boomeramg")
            self._default(HYPRE)
        else:
            pc.setType("gamg")
            self._default(GAMG)

    def _default(self, options: dict[str, str]) -> None:
        for name, value in options.items():
            if not self._given.hasName(PREFIX + name):
                self._given.setValue(PREFIX + name, value)
                self._ours.append(PREFIX + name)

    def solve(self, rhs: Real) -> Real:
        """This rank's part of the solution for its part of a right-hand side.

        Raises
        ------
        SolverError
            The tolerance is not reached.
        """
        self._rhs.setArray(rhs)
        norm = float(self._rhs.norm())
        if norm == 0.0:
            return np.zeros_like(rhs)
        if not np.isfinite(norm):
            raise SolverError("A right-hand side is not finite; the mesh has faces too thin for doubles.")
        try:
            self._ksp.solve(self._rhs, self._x)
        except self._petsc.Error as error:
            raise SolverError(f"PETSc's {self.solver} failed: {_reason(error)}. Choose another solver.") from error
        steps, reason = int(self._ksp.getIterationNumber()), int(self._ksp.getConvergedReason())
        self.steps.append(steps)
        if reason < 0 and not self._nearly(norm):
            raise SolverError(
                f"Conjugate gradients with {self.solver} stopped after {steps} steps (PETSc's reason {reason}); "
                "faces are too thin for it: choose the solver mumps, or remesh."
            )
        return np.array(self._x.getArray(readonly=True))

    def _nearly(self, norm: float) -> bool:
        """Whether rounding alone keeps the residual from the tolerance."""
        left = float(self._ksp.getResidualNorm()) / norm
        log.warning("%s stopped at %.1e of its right-hand side, not %.1e", self.solver, left, TOLERANCE)
        return left < 1e3 * TOLERANCE


def _chosen(petsc: Any, solver: DistributedSolver) -> DistributedSolver:
    if solver is not DistributedSolver.AUTO:
        return solver
    return DistributedSolver.HYPRE if petsc.Sys.hasExternalPackage("hypre") else DistributedSolver.GAMG


def _reason(error: Any) -> str:
    return f"error {getattr(error, 'ierr', '?')}"
