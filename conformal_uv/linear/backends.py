"""Which library solves the linear systems.

CHOLMOD where cvxopt is installed, else SuperLU, which comes with scipy; conjugate gradients with pyamg's multigrid
where a factorization would not fit into the memory at hand.
"""

from __future__ import annotations

import importlib.util
import logging
import os

import numpy as np
from numpy.typing import NDArray

from ..errors import MissingDependencyError, OptionError
from ..options import Backend
from ..progress import Progress
from .cholesky import Cholmod, SuperLU
from .linear_system import LinearSolver, LowerTriangle
from .memory import factorization_fits
from .multigrid import Multigrid, require_pyamg

__all__ = ["BACKENDS", "choose_backend", "linear_solver"]

BACKENDS = tuple(kind.value for kind in Backend if kind not in (Backend.AUTO, Backend.PETSC))
ENVIRONMENT_VARIABLE = "CONFORMAL_UV_BACKEND"
log = logging.getLogger(__name__)


def choose_backend(backend: str = "auto") -> str:
    """Name of the library to use.

    "auto" takes what the environment variable CONFORMAL_UV_BACKEND names, else CHOLMOD where it is installed,
    else SuperLU.

    Raises
    ------
    OptionError
        An unknown name, or "petsc", which is no solver of one process.
    MissingDependencyError
        "cholmod" without cvxopt, "multigrid" without pyamg.
    """
    name = _named(backend)
    available = importlib.util.find_spec("cvxopt") is not None
    if name == Backend.PETSC:
        raise OptionError(
            'The backend "petsc" maps one surface that is spread over MPI processes, to the disk: use '
            "distributed_disk_map(), or mpiexec -n 2 conformal-uv disk IN OUT --backend petsc."
        )
    if name == "auto":
        return "cholmod" if available else "superlu"
    if name not in BACKENDS:
        raise OptionError(f"Unknown backend {name!r}; choose auto, {', '.join(BACKENDS[:-1])} or {BACKENDS[-1]}.")
    if name == "cholmod" and not available:
        raise MissingDependencyError('The backend "cholmod" needs cvxopt: pip install cvxopt, or use "superlu".')
    if name == "multigrid":
        require_pyamg()
    return name


def linear_solver(
    matrix: LowerTriangle,
    backend: str = "auto",
    progress: Progress | None = None,
    order: NDArray[np.int32] | None = None,
) -> LinearSolver:
    """Make a symmetric positive definite matrix ready to be solved with.

    Parameters
    ----------
    matrix : LowerTriangle
    backend : {"auto", "cholmod", "superlu", "multigrid"}
        "auto", where the environment names none either, is a factorization as long as that fits into memory, and
        multigrid beyond, if pyamg is installed.
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
    if _named(backend) == "auto" and not factorization_fits(matrix.n, name):
        if importlib.util.find_spec("pyamg") is not None:
            name = "multigrid"
            log.info("a factorization of %d unknowns does not fit into memory: multigrid instead", matrix.n)
        else:
            log.warning(
                "a factorization of %d unknowns may not fit into memory; conformal-uv[large] has another way", matrix.n
            )
    if name == "multigrid":
        return Multigrid(matrix, progress)
    return (Cholmod if name == "cholmod" else SuperLU)(matrix, progress, order)


def _named(backend: str) -> str:
    """The backend asked for, by the caller or by the environment."""
    if backend == "auto":
        return os.environ.get(ENVIRONMENT_VARIABLE, "").strip().lower() or "auto"
    return backend
