"""What an iteration tells of itself: a row for each iterate, and how far it has come."""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

import numpy as np

__all__ = ["AugmentedLagrangianStep", "NewtonStep", "Status", "log_fraction"]


class Status(StrEnum):
    """Why a method stopped; a member is equal to its name.

    Attributes
    ----------
    DIRECT
        Nothing is iterated.
    CONVERGED
        The tolerance was reached.
    STALLED
        No step lowers the energy any more, as far as doubles tell.
    MAX_ITERATIONS
        `max_iterations` were made.
    ANGLES
        Newton's method, or a refinement, made the angle error larger, so the map before it was kept.
    NO_GAIN
        Of "auto": Newton's method promised too little to be begun, so the linear map was kept.
    """

    DIRECT = "direct"
    CONVERGED = "converged"
    STALLED = "stalled"
    MAX_ITERATIONS = "max-iterations"
    ANGLES = "angles"
    NO_GAIN = "no-gain"


class NewtonStep(NamedTuple):
    """What the solver saw at one iterate.

    Attributes
    ----------
    energy : float
        Conformal or Dirichlet energy.
    gradient_norm : float
        Euclidean norm of the projected gradient, on the disk in the boundary angles.
    cg_steps : int
        Conjugate gradient steps for the direction taken from here.
    step_length : float
        Part of the Newton direction taken, 0 at the last iterate.
    """

    energy: float
    gradient_norm: float
    cg_steps: int
    step_length: float


class AugmentedLagrangianStep(NamedTuple):
    """A row of the report's table: penalty, norm of the constraints, norm of the KKT residual.

    The KKT residual is that of the iterate and the multipliers from before this row's minimisation.
    """

    rho: float
    constraint_norm: float
    kkt_norm: float


def log_fraction(norm: float, first: float, tolerance: float) -> float:
    """How far the logarithm of a norm has come from that of the first to that of the tolerance, 0 .. 1."""
    if norm <= tolerance or first <= tolerance:
        return 1.0
    return float(np.clip(np.log(first / norm) / np.log(first / tolerance), 0.0, 1.0))
