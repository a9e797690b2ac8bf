"""The centre of a map is known only to within a cell of the mesh; inside it, the least energy decides.

A vertex held at 0 is off the point that belongs there by a fraction of an edge, and a Moebius map by so little
already costs discrete energy: a flat disk would not come back as itself. Where that is a good part of the energy, and
the minimum with the centre's image free leaves it within the star of the central vertex, that minimum is the map.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ..mesh.surface import Surface
from ..operators.dirichlet import DirichletProblem
from ..options import DiskOptions
from ..progress import Progress
from .boundary_energy import BoundaryEnergy
from .gauge import TurnGauge
from .harmonic_measure import CentredMeasure
from .newton import NewtonResult, minimise_boundary_energy

__all__ = ["release_centre", "released_within"]

WORTH_WHILE = 0.1  # part of the energy that there must be to gain


def release_centre(
    surface: Surface,
    problem: DirichletProblem,
    measure: CentredMeasure,
    found: NewtonResult,
    options: DiskOptions,
    progress: Progress,
) -> NewtonResult:
    """Minimise without holding the centre, where that is worth while and keeps it in its cell.

    Parameters
    ----------
    found : NewtonResult
        The minimum with the centre at 0.

    Returns
    -------
    The new minimum, or `found`.
    """
    if measure.centre is None:
        return found
    return released_within(
        partial(_star_radius, surface, problem, measure.centre), problem, measure, found, options, progress
    )


def released_within(
    reach_at: Callable[[BoundaryEnergy], float],
    problem: DirichletProblem,
    measure: CentredMeasure,
    found: NewtonResult,
    options: DiskOptions,
    progress: Progress,
) -> NewtonResult:
    """The same where the cell has the size `reach_at` in the map with an energy."""
    reach = reach_at(found.energy)
    worth = WORTH_WHILE * found.energy.value
    slope = found.energy.moebius_moves.T @ found.energy.gradient
    if 0.5 * float(np.linalg.norm(slope)) * reach < worth:  # a step within the star gains less, whatever the Hessian
        return found
    predicted, gain = _predicted_shift(found.energy, slope)
    if not predicted < reach or gain < worth:
        return found
    free = minimise_boundary_energy(
        problem,
        found.energy.theta,
        TurnGauge(measure.vertex_measure, found.energy.theta),
        minus_area=True,
        tolerance=max(options.tolerance, options.relative_tolerance * found.history[0].gradient_norm),
        max_iterations=options.max_iterations,
        progress=progress,
    )
    shift = abs(complex(measure.vertex_measure @ free.energy.z))
    if not (free.converged and shift < reach):
        return found
    return free._replace(history=found.history[:-1] + free.history)


def _star_radius(surface: Surface, problem: DirichletProblem, centre: int, energy: BoundaryEnergy) -> float:
    """Distance of the farthest neighbour of the central vertex from it in the map."""
    edges = surface.edges
    neighbours = np.concatenate((edges.hi[edges.lo == centre], edges.lo[edges.hi == centre]))
    z: NDArray[np.complex128] = np.empty(problem.n, dtype=np.complex128)
    z[problem.boundary], z[problem.interior] = energy.z, energy.interior
    return float(np.abs(z[neighbours] - z[centre]).max())


def _predicted_shift(energy: BoundaryEnergy, slope: NDArray[np.float64]) -> tuple[float, float]:
    """How far Newton's step in the two Moebius directions that move the centre would move it, and what it gains."""
    curvature = energy.moebius_moves.T @ energy.moebius_products()
    if np.linalg.eigvalsh(curvature)[0] <= 0.0:
        return np.inf, 0.0
    step = np.linalg.solve(curvature, slope)
    return float(np.linalg.norm(step)), 0.5 * float(slope @ step)
