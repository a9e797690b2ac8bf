"""The methods of the sphere, each from a closed surface to positions whose centre of mass is in the middle."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..mesh.surface import Surface
from ..operators.areas import lumped_areas
from ..operators.dirichlet import DirichletProblem
from ..operators.distortion import distortion_of
from ..operators.edge_laplacian import EdgeLaplacian, edge_laplacian
from ..operators.orientation_sign import inverted_faces
from ..optimize import AugmentedLagrangianStep, NewtonStep, Status, augmented_lagrangian
from ..optimize.choice import UNSEEN, best_map
from ..options import Repair, SphereMethod, SphereOptions
from ..progress import Progress
from .augmented_lagrangian import SphereProblem
from .centring import centred, unit
from .energy import SphereEnergy
from .newton import minimise_sphere_energy
from .puncture import linear_sphere, most_regular_vertex, punctures
from .repair import embeddings, mended
from .schwarz import TwoCharts

__all__ = ["ClosedSurface", "SphereSolution"]

Real = NDArray[np.float64]

LARGE = 10_000  # vertices, from where on one puncture must do and "auto" does without Newton's method
WATCHED = 2_000  # from where on "auto" gives Newton's method up once it makes the angles worse
PUNCTURES = 4  # that are tried on smaller surfaces


class SphereSolution(NamedTuple):
    """Positions x (n, 3) on the unit sphere, the centre of mass in the middle, and how they were come by.

    `unfolded` counts the inverted faces that were mended, `folds` are those that are left, `angle_mean` is in degrees.
    """

    x: Real
    method: SphereMethod
    status: Status
    history: tuple[NewtonStep, ...] | tuple[AugmentedLagrangianStep, ...]
    unfolded: int
    folds: NDArray[np.int64]
    angle_mean: float


class ClosedSurface:
    """A closed surface with what all methods need of it.

    Parameters
    ----------
    surface : Surface
        Closed, of genus 0.
    options : SphereOptions
    backend : str
    progress : Progress
    """

    def __init__(self, surface: Surface, options: SphereOptions, backend: str, progress: Progress) -> None:
        self.surface, self._options, self._backend, self._progress = surface, options, backend, progress
        mass = lumped_areas(surface.geometry, surface.corners, surface.n)
        self.mass = mass / mass.sum() if mass.sum() > 0.0 else np.full(surface.n, 1.0 / surface.n)
        self.laplacian: EdgeLaplacian = edge_laplacian(
            surface.corners, surface.edges, surface.geometry, surface.n, options.laplacian
        )

    def solved(self) -> SphereSolution:
        """By the method of the options."""
        method = self._options.method
        linear, raw = self._linear()
        if method is SphereMethod.LINEAR:
            return linear
        if method is SphereMethod.AUGMENTED_LAGRANGIAN:
            return self._augmented_lagrangian(linear)
        candidates = [linear]
        schwarz = self._schwarz(raw)
        if schwarz is not None:
            candidates.append(schwarz)
        best = self._better(candidates)
        if method is SphereMethod.SCHWARZ:
            return schwarz if schwarz is not None else linear
        if method is SphereMethod.NEWTON:
            return self._newton(best)
        if self.surface.n >= LARGE:
            return best._replace(status=Status.NO_GAIN)
        newton = self._newton(best, best.angle_mean + UNSEEN if self.surface.n >= WATCHED else np.inf)
        chosen = self._better([*candidates, newton] if len(newton.history) > 1 else candidates)
        return chosen if chosen.method is SphereMethod.NEWTON else chosen._replace(status=Status.ANGLES)

    def _linear(self) -> tuple[SphereSolution, Real]:
        """The best of the linear maps from some punctures, and its positions before any repair."""
        surface = self.surface
        count = PUNCTURES if surface.n < LARGE else 1
        maps = [
            centred(linear_sphere(surface, vertex, self._options.laplacian, self._backend, self._progress), self.mass)
            for vertex in punctures(surface, count)
        ]
        x = maps[0] if len(maps) == 1 else min(maps, key=self._angle_mean)
        return self._finished(x, SphereMethod.LINEAR, Status.DIRECT), x

    def _schwarz(self, x: Real) -> SphereSolution | None:
        """From the positions of a linear map; None where that has no two charts."""
        charts = TwoCharts(self.laplacian, x, self.surface.V, self._backend, self._progress)
        if not charts.usable:
            return None
        corners = self.surface.corners
        found = centred(charts.alternated(x), self.mass)
        relaxed = centred(charts.relaxed(found, corners), self.mass)
        sound = set(inverted_faces(relaxed, corners)) <= set(inverted_faces(found, corners))
        if sound and self._angle_mean(relaxed) < self._angle_mean(found):
            found = relaxed
        return self._finished(found, SphereMethod.SCHWARZ, Status.DIRECT)

    def _newton(self, start: SphereSolution, most: float = np.inf) -> SphereSolution:
        """The minimiser of the conformal energy near a solution; given up at a mean angle error over `most`."""
        surface, options = self.surface, self._options
        grounded = np.array([most_regular_vertex(surface)])
        problem = DirichletProblem(
            self.laplacian, grounded, surface.n, points=surface.V, backend=self._backend, progress=self._progress
        )
        found = minimise_sphere_energy(
            SphereEnergy(self.laplacian, surface.corners, start.x),
            problem,
            self.mass,
            tolerance=options.tolerance,
            max_iterations=options.max_iterations,
            progress=self._progress,
            watch=lambda x: most == np.inf or self._angle_mean(x) <= most,
        )
        return self._finished(found.x, SphereMethod.NEWTON, found.status, found.history, start.unfolded)

    def _augmented_lagrangian(self, start: SphereSolution) -> SphereSolution:
        flat, history, converged = augmented_lagrangian(
            SphereProblem(self.laplacian, self.surface.corners, self.mass),
            start.x.reshape(-1),
            max_iterations=self._options.max_iterations,
            progress=self._progress,
        )
        status = Status.CONVERGED if converged else Status.MAX_ITERATIONS
        x = unit(flat.reshape(-1, 3))
        return self._finished(x, SphereMethod.AUGMENTED_LAGRANGIAN, status, history, start.unfolded)

    def _finished(
        self,
        x: Real,
        method: SphereMethod,
        status: Status,
        history: tuple[NewtonStep, ...] | tuple[AugmentedLagrangianStep, ...] = (),
        unfolded: int = 0,
    ) -> SphereSolution:
        """Positions after the repair, centred again."""
        start = folds = inverted_faces(x, self.surface.corners)
        mean = self._angle_mean(x)
        if self._options.repair is not Repair.NEVER and len(folds):
            most = mean + self._options.repair.pays
            for moved in self._unfolded(x, folds):
                left, cost = inverted_faces(moved, self.surface.corners), self._angle_mean(moved)
                if len(left) < len(folds) and cost <= most:
                    x, folds, mean = moved, left, cost
                if not len(folds):
                    break
        return SphereSolution(x, method, status, history, unfolded + len(start) - len(folds), folds, mean)

    def _unfolded(self, x: Real, folds: NDArray[np.int64]) -> Iterator[Real]:
        """Positions with fewer folds, dearer and dearer; the centre of mass but for patches in the middle."""
        surface, progress = self.surface, self._progress
        yield mended(surface, centred(mended(surface, x, progress), self.mass), progress)
        if self._options.repair is Repair.ALWAYS:
            for embedded in embeddings(surface, x, folds):
                yield mended(surface, centred(mended(surface, embedded, progress), self.mass), progress)

    def _angle_mean(self, x: Real) -> float:
        return distortion_of(self.surface.geometry, self.surface.corners, x).angle_mean

    def _better(self, solutions: list[SphereSolution]) -> SphereSolution:
        """The best of them; where folds are to be mended whatever it costs, they come first."""
        folds_first = self._options.repair is Repair.ALWAYS
        means = [one.angle_mean for one in solutions]
        folds = [len(one.folds) for one in solutions]
        stalled = [one.status is Status.STALLED for one in solutions]
        return solutions[best_map(means, folds, stalled, folds_first=folds_first)]
