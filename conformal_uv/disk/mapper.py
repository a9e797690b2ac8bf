"""A surface factorized once, to be mapped to the disk again and again."""

from __future__ import annotations

import logging
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..mesh.surface import Surface
from ..operators.dirichlet import DirichletProblem
from ..operators.laplacian import cotangent_weights
from ..operators.wirtinger import conformal_energy, planar_sides, signed_double_areas
from ..progress import Callback, Progress
from .harmonic_measure import CentredMeasure, centred_measure
from .options import DiskOptions
from .placement import place_center, place_pins
from .result import DiskMap
from .solution import Solution, solve_augmented_lagrangian, solve_linear, solve_newton

__all__ = ["DiskMapper"]

log = logging.getLogger(__name__)


class DiskMapper:
    """A mesh checked and factorized once, to be mapped again with other options.

    Parameters
    ----------
    V, F, backend, callback
        As in `disk_map`, with the same errors.

    Attributes
    ----------
    surface : Surface
    boundary : (nb,) int64
        The boundary loop, in the direction of the faces.
    """

    def __init__(
        self, V: ArrayLike, F: ArrayLike, *, backend: str = "auto", callback: Callback | None = None
    ) -> None:
        progress = Progress(callback)
        progress("checks", 0.0)
        self.surface = Surface.from_arrays(V, F)
        self.boundary = self.surface.require_disk()
        weights = cotangent_weights(self.surface.edges, self.surface.geometry)
        self._problem = DirichletProblem(
            self.surface.edges, weights, self.boundary, self.surface.n, backend=backend, progress=progress
        )
        self._measure: CentredMeasure | None = None
        self._solved: tuple[tuple[object, ...], Solution] | None = None

    @property
    def backend(self) -> str:
        """Library of the factorization."""
        return self._problem.backend

    def map(
        self,
        *,
        method: str = "newton",
        objective: str | None = None,
        pins: Sequence[int] | None = None,
        pin_mode: str | None = None,
        center: int | None = None,
        boundary_vertex: int | None = None,
        tolerance: float = 1e-10,
        max_iterations: int = 50,
        callback: Callback | None = None,
    ) -> DiskMap:
        """The map with the given options; see `disk_map`.

        The last solution is kept: another center, boundary vertex or pins only place it anew by a Moebius map.
        """
        options = DiskOptions.checked(
            self.surface,
            self.boundary,
            method=method,
            objective=objective,
            pins=pins,
            pin_mode=pin_mode,
            center=center,
            boundary_vertex=boundary_vertex,
            tolerance=tolerance,
            max_iterations=max_iterations,
        )
        progress = Progress(callback)
        if self._solved is None or self._solved[0] != options.solution_key:
            self._solved = options.solution_key, self._solve(options, progress)
        solution = self._solved[1]
        if not solution.converged:
            log.warning("%s stopped before its tolerance, after %d rows", method, len(solution.history))
        progress("placement", 0.0)
        result = self._placed(solution, options)
        progress("placement", 1.0)
        return result

    def _solve(self, options: DiskOptions, progress: Progress) -> Solution:
        if options.method == "augmented-lagrangian":
            return solve_augmented_lagrangian(self.surface, self.boundary, options, self.backend, progress)
        progress("linear", 0.0)
        if self._measure is None:
            self._measure = centred_measure(self.surface, self._problem)
        if options.method == "linear":
            return solve_linear(self._problem, self._measure)
        return solve_newton(self.surface, self._problem, self._measure, options, progress)

    def _placed(self, solution: Solution, options: DiskOptions) -> DiskMap:
        corners = self.surface.corners
        center = solution.center if options.center is None else options.center
        if solution.fixed:
            z = solution.z
        elif options.pins is not None:
            z, center = place_pins(self._problem, corners, solution.z, options.pins), None
        else:
            first = int(self.boundary[0]) if options.boundary_vertex is None else options.boundary_vertex
            z = place_center(self._problem, corners, solution.z, center, first)
        return self._result(z, center, solution, options)

    def _result(
        self, z: NDArray[np.complex128], center: int | None, solution: Solution, options: DiskOptions
    ) -> DiskMap:
        sides = planar_sides(z, self.surface.corners)
        signed = signed_double_areas(sides)
        energy = conformal_energy(self.surface.geometry, sides)
        return DiskMap(
            uv=z.copy().view(np.float64).reshape(-1, 2),
            boundary=self.boundary,
            dirichlet_energy=energy + 0.5 * float(signed.sum()),
            conformal_energy=energy,
            flipped=np.flatnonzero(signed <= 0.0),
            converged=solution.converged,
            history=solution.history,
            method=options.method,
            objective=options.objective,
            center=center,
            pins=options.pins,
            backend=self.backend,
            surface=self.surface,
        )
