"""Iterations that minimise: what Newton's methods and augmented Lagrangians of all shapes have in common."""

from .augmented_lagrangian import ConstrainedProblem, augmented_lagrangian
from .history import AugmentedLagrangianStep, NewtonStep, Status, log_fraction
from .lbfgs import Barrier, lbfgs
from .line_search import SUFFICIENT_DECREASE, line_search
from .truncated_cg import truncated_cg

__all__ = [
    "SUFFICIENT_DECREASE",
    "AugmentedLagrangianStep",
    "Barrier",
    "ConstrainedProblem",
    "NewtonStep",
    "Status",
    "augmented_lagrangian",
    "lbfgs",
    "line_search",
    "log_fraction",
    "truncated_cg",
]
