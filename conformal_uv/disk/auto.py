"""Whether Newton's method is worth its while after the linear map, decided by the angles themselves.

The energy weighs a face by its area in the image, so that its minimum may have more angle error than the linear map,
and by far more where faces are crowded. Small meshes are mapped both ways. On large ones the linear map is nearly
always the better one: Newton's method begins there only if the first step promises something, and goes on only while
the mean angle error falls.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.surface import Surface
from ..operators.angle_mean import AngleMean
from ..operators.dirichlet import DirichletProblem
from ..optimize import Status
from ..options import DiskOptions
from ..progress import Progress
from .boundary_energy import BoundaryEnergy
from .gauge import CentreGauge
from .harmonic_measure import CentredMeasure
from .preconditioner import FourierPreconditioner
from .relative_energy import few_enough
from .solution import LinearStart, Solution, solve_newton, solve_relative
from .tangent import Tangent

__all__ = ["solve_auto"]

LARGE = 10_000  # vertices, from where on Newton's method is watched
FEW = 32  # boundary vertices: a step costs as few solutions, and the preconditioner tells nothing
PROMISE = 0.003  # degrees of mean angle error that the fall of the energy would give by its square
WORTH = 3e-4  # part of the energy
GOOD = 0.5  # degrees, of which nobody asks for less
TINY = float(np.finfo(np.float64).tiny)


def solve_auto(
    surface: Surface, start: LinearStart, measure: CentredMeasure, options: DiskOptions, progress: Progress
) -> list[Solution]:
    """The linear solution and, where it may be the better one, Newton's; the linear one's status says why it is not.

    Parameters
    ----------
    start : LinearStart
        The linear solution with its energy.
    """
    linear, energy = start.solution, start.energy
    if surface.n < LARGE:
        newton = solve_newton(surface, energy.problem, measure, options, progress)
        return _with_relative(surface, energy.problem, [linear._replace(status=Status.ANGLES), newton])
    if not _promising(surface, energy, measure):
        return [linear._replace(status=Status.NO_GAIN)]
    watch = _Watch(surface, energy)
    newton = solve_newton(surface, energy.problem, measure, options, progress, watch)
    linear = linear._replace(status=Status.ANGLES)
    return _with_relative(surface, energy.problem, [linear, newton] if len(newton.history) > 1 else [linear])


def _with_relative(surface: Surface, problem: DirichletProblem, found: list[Solution]) -> list[Solution]:
    """With the least shear of all boundary angles, where there are few and the angles could be better."""
    last = found[-1]
    if not few_enough(surface, problem) or _angle_mean(surface, last.z) < GOOD:
        return found
    return [*found, *solve_relative(surface, problem, last)]


class _Watch:
    """True while the mean angle error falls."""

    def __init__(self, surface: Surface, energy: BoundaryEnergy) -> None:
        self._surface = surface
        self._least = _angle_mean(surface, energy.positions())

    def __call__(self, energy: BoundaryEnergy) -> bool:
        """Whether the angles at these boundary angles are no worse than before."""
        mean = _angle_mean(self._surface, energy.positions())
        if mean > self._least:
            return False
        self._least = mean
        return True


def _promising(surface: Surface, energy: BoundaryEnergy, measure: CentredMeasure) -> bool:
    """Whether the energy would fall by enough, as far as the preconditioner knows the Hessian."""
    if len(energy.theta) <= FEW:
        return True
    gauge = CentreGauge(measure.vertex_measure, energy.theta)
    tangent = Tangent(
        gauge, energy.theta, np.zeros(len(energy.theta), dtype=bool), FourierPreconditioner(len(energy.theta))
    )
    gradient = tangent.project(energy.gradient)
    part = 0.5 * float(gradient @ tangent.precondition(gradient)) / max(energy.value, TINY)
    return part > WORTH and part * _angle_mean(surface, energy.positions()) > PROMISE


def _angle_mean(surface: Surface, z: NDArray[np.complex128]) -> float:
    return AngleMean(surface, z).first
