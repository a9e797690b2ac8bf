"""Newton's method on the boundary angles: truncated conjugate gradients inside, a line search outside."""

from __future__ import annotations

import logging
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..operators.dirichlet import DirichletProblem
from ..operators.neumann_strip import SHORT
from ..optimize import NewtonStep, Status, line_search, log_fraction, truncated_cg
from ..progress import Progress
from .angle_steps import gaps, in_order
from .boundary_energy import BoundaryEnergy
from .gauge import Gauge
from .preconditioner import Preconditioner, preconditioner
from .tangent import Tangent

__all__ = ["NewtonResult", "minimise_boundary_energy"]

Real = NDArray[np.float64]
log = logging.getLogger(__name__)

EPS = np.finfo(np.float64).eps
SMALLEST_GAP = 1e-12  # radians; neighbours as near as that are linked
FIRST_FORCING = 0.01  # of the gradient is left by a direction, at most,
LEAST_FORCING = 1e-3  # and at least; the energy is so nearly quadratic that this pays
LAST_FORCING = 1e-5  # and by the last one,
LAST_PART = 0.7  # of the tolerance; the rest is for what is not quadratic
SHORT_PART = 0.01  # of it where the boundary is short: one step more costs next to nothing, and then nobody sees how
# directions were found


class NewtonResult(NamedTuple):
    """The energy at the angles found, the steps, whether the tolerance was reached, and whether neighbours came so
    close together that they were linked."""

    energy: BoundaryEnergy
    history: tuple[NewtonStep, ...]
    converged: bool
    status: Status
    linked: bool = False


def minimise_boundary_energy(
    problem: DirichletProblem,
    theta: Real,
    gauge: Gauge,
    *,
    minus_area: bool,
    tolerance: float,
    max_iterations: int,
    progress: Progress,
    relative_tolerance: float = 0.0,
    watch: Callable[[BoundaryEnergy], bool] = lambda energy: True,
    preconditioned: Callable[[DirichletProblem, Real], Preconditioner] = preconditioner,
) -> NewtonResult:
    """Minimise the energy over the boundary angles under the gauge.

    The energy never rises and the order of the boundary is never broken: a step that would make neighbours change
    places brings them nearer by a factor instead; where that has brought them together for doubles they are linked,
    and move together from then on unless the energy would fall by parting them. The iteration ends when the
    norm of the gradient, projected onto what gauge and links leave free, is at most `tolerance`, `relative_tolerance`
    times what it was at first, or the rounding of its terms, when no step lowers the energy any more, or after
    `max_iterations`.

    Parameters
    ----------
    theta : (nb,) float64
        Start, strictly increasing within one turn, but for neighbours too close for doubles.
    watch : callable
        Given the energy after each step; the iteration ends before the first where it is False.
    preconditioned : callable
        Gives the preconditioner for the angles at hand.
    """
    history: list[NewtonStep] = []
    energy = BoundaryEnergy(problem, gauge.restore(theta), minus_area=minus_area)
    links = gaps(energy.theta) < SMALLEST_GAP
    kept = np.full_like(links, links.any())  # on a crowded boundary gaps are mostly rounding, and links stay
    degrees = problem.Lbb.diagonal()
    rounding = 64.0 * float(EPS) * float(np.linalg.norm(degrees))
    asked, part = tolerance, SHORT_PART if len(theta) <= SHORT else 1.0
    tolerance = max(part * asked, rounding)
    first, status = None, Status.CONVERGED
    while True:  # every round makes a step or a link, and links are no more than vertices
        inverse = preconditioned(problem, energy.theta)
        tangent = Tangent(gauge, energy.theta, links, inverse)
        norm = float(np.linalg.norm(tangent.project(energy.gradient)))
        if norm <= tolerance:
            parting = links & ~kept & (tangent.pull_of_links(energy.gradient) < -tolerance)
            if parting.any():  # each link is let go at most once, so that this ends
                links, kept = links & ~parting, kept | parting
                tangent = Tangent(gauge, energy.theta, links, inverse)
                norm = float(np.linalg.norm(tangent.project(energy.gradient)))
        if first is None:
            first = norm
            asked = max(asked, relative_tolerance * first, rounding)
            tolerance = max(part * asked, rounding)
        reached = log_fraction(norm, first, tolerance)
        progress("newton", reached)
        if norm <= tolerance:
            break
        if len(history) == max_iterations:
            status = Status.CONVERGED if norm <= asked else Status.MAX_ITERATIONS
            break
        direction, cg_steps = _newton_direction(energy, gauge, tangent, tolerance, partial(progress, "newton", reached))
        closed = ~links & (gaps(energy.theta) < SMALLEST_GAP) & (np.roll(direction, -1) < direction)
        if closed.any() and (links | closed).sum() <= len(links) - 3:
            links = links | closed
            continue
        found = _line_search(energy, gauge, tangent, direction)
        if found is None:
            log.debug("no descent left at projected gradient %.3g", norm)
            status = Status.CONVERGED if norm <= asked else Status.STALLED
            break
        step_length, better = found
        if not watch(better):
            status = Status.ANGLES
            break
        history.append(NewtonStep(energy.value, norm, cg_steps, step_length))
        energy = better
    history.append(NewtonStep(energy.value, norm, 0, 0.0))
    return NewtonResult(energy, tuple(history), status is Status.CONVERGED, status, bool(links.any()))


def _newton_direction(
    energy: BoundaryEnergy, gauge: Gauge, tangent: Tangent, tolerance: float, watch: Callable[[], None]
) -> tuple[Real, int]:
    """Solve ``P H P d = -P g``, H the Hessian of the Lagrangian: energy less constraints times multipliers."""
    gradient = tangent.project(energy.gradient)
    bend = gauge.curvature(energy.theta, energy.gradient)
    norm = float(np.linalg.norm(gradient))
    goal = min(FIRST_FORCING, max(LEAST_FORCING, 0.5 * norm)) * norm
    if LAST_PART * tolerance > LAST_FORCING * norm:  # near enough to end with this step
        goal = LAST_PART * tolerance
    return truncated_cg(
        gradient, lambda d: tangent.project(energy.hessian_product(d) + bend * d), tangent.precondition, goal, watch
    )


def _line_search(
    energy: BoundaryEnergy, gauge: Gauge, tangent: Tangent, direction: Real
) -> tuple[float, BoundaryEnergy] | None:
    """From the whole step, along a curve that keeps the order of the boundary."""
    slope = float(energy.gradient @ direction)
    norm = np.linalg.norm(tangent.project(energy.gradient))
    degrees = energy.problem.Lbb.diagonal()
    solved = max(64.0 * float(EPS), 4.0 * energy.problem.accuracy)
    noise = solved * (abs(energy.value) + np.pi) + 4.0 * float(EPS) * float(np.linalg.norm(degrees))

    def move(length: float) -> BoundaryEnergy:
        theta = gauge.restore(in_order(energy.theta, length * direction))
        return BoundaryEnergy(energy.problem, theta, minus_area=energy.minus_area)

    def gradient_falls(there: BoundaryEnergy) -> bool:
        tangent_there = Tangent(gauge, there.theta, tangent.links, tangent.inverse)
        return bool(np.linalg.norm(tangent_there.project(there.gradient)) < norm)

    return line_search(energy.value, slope, move, gradient_falls, length=1.0, noise=noise)
