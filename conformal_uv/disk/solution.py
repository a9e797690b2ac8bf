"""The three methods, each from a factorized surface to the positions of all vertices in the disk."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..mesh.manifold import check_areas
from ..mesh.surface import Surface
from ..operators.dirichlet import DirichletProblem
from ..operators.edge_laplacian import uniform_edges
from ..operators.laplacian import cotangent_weights, laplacian_matrix
from ..operators.neumann_strip import SHORT
from ..optimize import AugmentedLagrangianStep, NewtonStep, Status, augmented_lagrangian
from ..options import DiskOptions, Method
from ..progress import Progress
from .augmented_lagrangian import area_hessian, circle_problem
from .boundary_energy import BoundaryEnergy
from .centre_cell import release_centre
from .gauge import CentreGauge, PinGauge
from .harmonic_measure import CentredMeasure
from .newton import NewtonResult, minimise_boundary_energy
from .placement import CUBE_ROOTS, place_pins
from .preconditioner import smooth_preconditioner
from .relative_energy import least_shear

__all__ = ["LinearStart", "Solution", "solve_augmented_lagrangian", "solve_linear", "solve_newton", "solve_relative"]

Complex = NDArray[np.complex128]


class Solution(NamedTuple):
    """Positions z (n,) in the unit disk, before they are placed.

    `problem` is what was solved, None for the
    augmented Lagrangian; `status` says why `method` stopped.
    """

    z: Complex
    history: tuple[NewtonStep, ...] | tuple[AugmentedLagrangianStep, ...]
    converged: bool
    problem: DirichletProblem | None
    method: Method
    status: Status
    relative: bool = False  # whether the shear was minimised, without a gauge


class LinearStart(NamedTuple):
    """The linear solution and the energy at it."""

    solution: Solution
    energy: BoundaryEnergy


def solve_linear(problem: DirichletProblem, measure: CentredMeasure) -> LinearStart:
    """Angles from the harmonic measure, then the harmonic extension."""
    theta = CentreGauge(measure.vertex_measure, measure.theta).restore(measure.theta)
    energy = BoundaryEnergy(problem, theta, minus_area=True)
    solution = Solution(energy.positions(), (), True, problem, Method.LINEAR, Status.DIRECT)
    return LinearStart(solution, energy)


def solve_newton(
    surface: Surface,
    problem: DirichletProblem,
    measure: CentredMeasure,
    options: DiskOptions,
    progress: Progress,
    watch: Callable[[BoundaryEnergy], bool] = lambda energy: True,
) -> Solution:
    """From the linear solution, the boundary angles that minimise the energy; it ends where `watch` says so."""
    loop = problem.boundary
    gauge: CentreGauge | PinGauge = CentreGauge(measure.vertex_measure, measure.theta)
    theta, pins = measure.theta, options.constrained_pins
    if pins is not None:
        start = solve_linear(problem, measure).solution.z
        placed, _ = place_pins(problem, surface.corners, start, pins)
        theta = _angles(placed[loop])
        gauge = PinGauge(np.array([np.flatnonzero(loop == pin)[0] for pin in pins]))
    minimised = partial(
        minimise_boundary_energy,
        problem,
        theta,
        gauge,
        minus_area=options.objective == "conformal",
        tolerance=options.tolerance,
        relative_tolerance=options.relative_tolerance,
        max_iterations=options.max_iterations,
        progress=progress,
        watch=watch,
    )
    found: NewtonResult = minimised()
    if found.linked and found.status in {Status.STALLED, Status.MAX_ITERATIONS} and len(theta) > SHORT:
        # A crowded boundary: on a surface stretched 1e5 times smooth directions lead past where others end.
        again = minimised(preconditioned=smooth_preconditioner)
        found = again if again.converged or again.energy.value < found.energy.value else found
    if pins is None and options.objective == "conformal" and found.converged:
        found = release_centre(surface, problem, measure, found, options, progress)
    z = found.energy.positions()
    if pins is not None:
        z[list(pins)] = CUBE_ROOTS
    done = found.converged or found.status is Status.ANGLES
    return Solution(z, found.history, done, problem, Method.NEWTON, found.status)


def solve_relative(surface: Surface, problem: DirichletProblem, start: Solution) -> list[Solution]:
    """The least shear of all boundary angles near those of another solution, by two measures of it."""
    return [
        Solution(
            problem.extend(np.exp(1j * theta)),
            steps,
            True,
            problem,
            Method.NEWTON,
            Status.CONVERGED,
            relative=True,
        )
        for theta, steps in least_shear(surface, problem, _angles(start.z[problem.boundary]))
    ]


def solve_augmented_lagrangian(
    surface: Surface, loop: NDArray[np.int64], options: DiskOptions, backend: str, progress: Progress
) -> Solution:
    """The report's algorithm from Tutte's embedding with uniform weights and an equally spaced boundary.

    Raises
    ------
    DegenerateFaceError
        Faces without area have no cotangents.
    """
    check_areas(surface.geometry)
    edges, n = surface.edges, surface.n
    tutte = DirichletProblem(uniform_edges(edges), loop, n, points=surface.V, backend=backend)
    start = tutte.extend(np.exp(2j * np.pi / len(loop) * np.arange(len(loop))))
    problem = circle_problem(
        laplacian_matrix(edges, 2.0 * cotangent_weights(edges, surface.geometry), n),
        loop,
        np.array(options.pins),
        area=area_hessian(loop, n) if options.objective == "conformal" else None,
    )
    x, history, converged = augmented_lagrangian(
        problem,
        np.concatenate((start.real, start.imag)),
        max_iterations=options.max_iterations,
        progress=progress,
    )
    z = x[:n] + 1j * x[n:]
    z[loop] /= np.abs(z[loop])  # the constraints hold to 1e-8, the circle is to be met
    status = Status.CONVERGED if converged else Status.MAX_ITERATIONS
    return Solution(z, history, converged, None, Method.AUGMENTED_LAGRANGIAN, status)


def _angles(zb: Complex) -> NDArray[np.float64]:
    """Increasing angles of points that go once around the circle."""
    turn = np.angle(np.roll(zb, -1) / zb) % (2.0 * np.pi)
    return np.angle(zb[0]) + np.concatenate(([0.0], np.cumsum(turn)[:-1]))
