"""The outer iteration of the report's augmented Lagrangian: penalty and multipliers.

C. P. Choi, "Conformal parameterization of a surface", sections 3-4 and the code of its appendix.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..progress import Progress
from .history import AugmentedLagrangianStep, log_fraction

__all__ = ["ConstrainedProblem", "augmented_lagrangian"]

Real = NDArray[np.float64]

FIRST_PENALTY = 10.0
STOP = 1e-8  # for both norms


class ConstrainedProblem(Protocol):
    """An objective under the constraints c(x) = 0, and the minimisation of its augmented Lagrangian in x.

    The augmented Lagrangian is ``objective - y' c + rho / 2 c' c``.
    """

    def constraints(self, x: Real) -> Real:
        """c(x), (k,)."""
        ...

    def kkt_residual(self, x: Real, y: Real) -> float:
        """Norm of the gradient of the objective less ``[grad c(x)] y``."""
        ...

    def minimised(self, x: Real, y: Real, rho: float, tolerance: float) -> Real:
        """The minimiser near x, to a gradient of this norm."""
        ...


def augmented_lagrangian(
    problem: ConstrainedProblem, x: Real, *, max_iterations: int, progress: Progress
) -> tuple[Real, tuple[AugmentedLagrangianStep, ...], bool]:
    """The last iterate, the rows of the report's table, and whether both norms fell below 1e-8."""
    y = np.zeros(len(problem.constraints(x)))
    rho, updates = FIRST_PENALTY, 0
    history: list[AugmentedLagrangianStep] = []
    for iteration in range(1, max_iterations + 1):
        before = problem.kkt_residual(x, y)
        x = problem.minimised(x, y, rho, 1e-4 / 10.0**iteration)
        c = problem.constraints(x)
        norm = float(np.linalg.norm(c))
        history.append(AugmentedLagrangianStep(rho, norm, before))
        progress("augmented lagrangian", log_fraction(norm, 1.0, STOP))
        if norm < 1e-3 / 2.0**updates:
            y = y - rho * c
            updates += 1
        else:
            rho *= 2.0
        if norm < STOP and problem.kkt_residual(x, y) < STOP:
            return x, tuple(history), True
    return x, tuple(history), False
