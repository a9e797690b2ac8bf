"""A surface checked and factorized once, to be mapped to the disk again and again."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..mesh.mesh_objects import MeshObject
from ..operators.angle_mean import AngleMean
from ..operators.dirichlet import DirichletProblem
from ..operators.factorized_disk import FactorizedDisk
from ..operators.nearby_maps import NearbyMaps
from ..operators.orientation_sign import flipped_faces
from ..optimize.choice import best_map
from ..options import Balance, DiskOptions, Laplacian, Method, Objective, Repair
from ..progress import Callback, Progress
from .anchors import anchored
from .auto import solve_auto
from .balance import balance_point
from .ears import doubtful_faces
from .embedding import unfolded
from .harmonic_measure import CentredMeasure, centred_measure
from .placement import inside_disk, place_balanced, place_center, place_pins
from .repair import Repair as RepairCost
from .repair import recentred, repair_cost
from .result import DiskMap, disk_map_result
from .solution import Solution, solve_augmented_lagrangian, solve_linear, solve_newton
from .spacing import with_distinct_boundary

__all__ = ["DiskMapper"]

Turn = Callable[[NDArray[np.complex128]], complex]
log = logging.getLogger(__name__)


class _Finished(NamedTuple):
    """A solution where it was placed, its folds, what their repair cost, and the vertex at 0."""

    solution: Solution
    z: NDArray[np.complex128]
    flipped: NDArray[np.int64]
    cost: RepairCost | None
    center: int | None


class DiskMapper:
    """A mesh checked once and factorized at its first map, to be mapped again with other options.

    Parameters
    ----------
    V, F, laplacian, backend, callback
        As in `disk_map`, with the same errors.

    Attributes
    ----------
    surface : Surface
    boundary : (nb,) int64
        The boundary loop, in the direction of the faces.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> from conformal_uv.samples import mask
    >>> mapper = cuv.DiskMapper(*mask(500))
    >>> a, b = mapper.map(method="linear"), mapper.map(method="newton")
    >>> b.conformal_energy < a.conformal_energy
    True
    """

    def __init__(
        self,
        V: ArrayLike | MeshObject,
        F: ArrayLike | None = None,
        *,
        laplacian: str = "auto",
        backend: str = "auto",
        callback: Callback | None = None,
    ) -> None:
        self._take(FactorizedDisk(V, F, laplacian=laplacian, backend=backend, callback=callback))

    @classmethod
    def of(cls, factorized: FactorizedDisk) -> DiskMapper:
        """A mapper of a surface that may be factorized already, and shares that with other shapes."""
        mapper = cls.__new__(cls)
        mapper._take(factorized)
        return mapper

    def _take(self, factorized: FactorizedDisk) -> None:
        self._factorized = factorized
        self.surface, self.boundary, self.backend = factorized.surface, factorized.boundary, factorized.backend
        self._measured: dict[Laplacian, CentredMeasure] = {}
        self._solved: tuple[tuple[object, ...], list[Solution]] | None = None

    def map(self, *, callback: Callback | None = None, **options: Any) -> DiskMap:
        """The map with the given options; see `disk_map`.

        The last solution is kept: another center, boundary vertex or pins only place it anew by a Moebius map.
        """
        return self.solved(DiskOptions(**options), callback)

    def solved(self, options: DiskOptions, callback: Callback | None = None, turn: Turn | None = None) -> DiskMap:
        """The same, the options in one object, the disk turned by what `turn` says of the positions (n,)."""
        options = anchored(options, self.surface.n, self.boundary)
        progress = Progress(callback)
        if self._solved is None or self._solved[0] != options.solution_key:
            self._solved = options.solution_key, self._solve(options, progress)
        progress("placement", 0.0)
        candidates = [self._finished(solution, options, turn, progress) for solution in self._solved[1]]
        always = options.repair is Repair.ALWAYS
        found = candidates[0] if len(candidates) == 1 else self._better(candidates, always)
        solution = found.solution
        if not solution.converged:
            log.warning("%s stopped before its tolerance, after %d rows", solution.method, len(solution.history))
        result = disk_map_result(self.surface, solution, options, found.z, found.flipped, found.cost, found.center)
        progress("placement", 1.0)
        return result

    def _solve(self, options: DiskOptions, progress: Progress) -> list[Solution]:
        if options.method is Method.AUGMENTED_LAGRANGIAN:
            return [solve_augmented_lagrangian(self.surface, self.boundary, options, self._factorized.asked, progress)]
        problem, measure = self._problem(options, progress)
        if options.method is Method.NEWTON:
            return [solve_newton(self.surface, problem, measure, options, progress)]
        start = solve_linear(problem, measure)
        if options.method is Method.LINEAR:
            return [start.solution]
        return solve_auto(self.surface, start, measure, options, progress)

    def _finished(self, solution: Solution, options: DiskOptions, turn: Turn | None, progress: Progress) -> _Finished:
        """A solution placed, turned and repaired as the options ask for."""
        fixed, cost = self._held(options), None
        z, flipped, center = self._placed(solution, options)
        by = 1.0 if turn is None else turn(z)
        if by != 1.0:
            z = inside_disk(z * by)
            flipped = flipped_faces(z, self.surface.corners)
        distinct = with_distinct_boundary(z, self.boundary, fixed)
        if distinct is not z:
            z, flipped = distinct, flipped_faces(distinct, self.surface.corners)
        if options.repair is Repair.NEVER or solution.problem is None:
            return _Finished(solution, z, flipped, cost, center)
        corners = self.surface.corners
        doubtful = doubtful_faces(z, corners, self.boundary)
        if len(doubtful):
            folded, before, maps = z, flipped, NearbyMaps(self.surface, z, flipped)
            z = unfolded(self.surface, solution.problem, z, maps, doubtful, fixed, options.repair, progress)
            if z is not folded:
                z = recentred(z, center, corners) if options.pins is None else z
                flipped = maps.flipped(z)
                cost = repair_cost(maps, folded, z, before, flipped)
            center = center if center is not None and z[center] == 0.0 else None
        return _Finished(solution, z, flipped, cost, center)

    def _better(self, candidates: list[_Finished], always: bool) -> _Finished:
        """The best of them; where folds are `always` mended whatever it costs, they come first."""
        surface = self.surface
        means = [AngleMean(surface, one.z).first for one in candidates]
        folds = [len(one.flipped) for one in candidates]
        unfinished = [not one.solution.converged for one in candidates]
        return candidates[best_map(means, folds, unfinished, folds_first=always)]

    def _problem(self, options: DiskOptions, progress: Progress) -> tuple[DirichletProblem, CentredMeasure]:
        """The factorization and the harmonic measure that the options need, made at the first call.

        The Dirichlet objective is the report's problem, stated with the mesh's own cotangents; "auto" keeps them.
        """
        kind = self._factorized.kind
        if kind is Laplacian.AUTO and options.objective is Objective.DIRICHLET and not len(self.surface.degenerate):
            kind = Laplacian.COTAN
        problem = self._factorized.problem(progress, kind)
        if kind not in self._measured:
            progress("linear", 0.0)
            self._measured[kind] = centred_measure(self.surface, problem)
        return problem, self._measured[kind]

    def _held(self, options: DiskOptions) -> NDArray[np.int64]:
        """The boundary vertices whose places the options name."""
        if options.pins is not None:
            return np.array(options.pins)
        return np.array([self.boundary[0] if options.boundary_vertex is None else options.boundary_vertex])

    def _placed(
        self, solution: Solution, options: DiskOptions
    ) -> tuple[NDArray[np.complex128], NDArray[np.int64], int | None]:
        """Positions after the Moebius map that the options ask for, the faces folded there, and the vertex at 0."""
        corners = self.surface.corners
        if solution.problem is None or options.constrained_pins is not None:
            z = inside_disk(solution.z)
            return z, flipped_faces(z, corners), None
        if options.pins is not None:
            apart = with_distinct_boundary(solution.z, self.boundary, self.boundary[:1])  # pins that crowd, too
            return *place_pins(solution.problem, corners, apart, options.pins), None
        first = int(self.boundary[0]) if options.boundary_vertex is None else options.boundary_vertex
        if options.balance is Balance.AREA:
            point = balance_point(self.surface, solution.z)
            return *place_balanced(solution.problem, corners, solution.z, point, first), None
        return *place_center(solution.problem, corners, solution.z, options.center, first), options.center
