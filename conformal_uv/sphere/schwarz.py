"""Schwarz's alternating method: two charts of the sphere, each harmonic in turn where the other is held.

A map from a punctured surface is harmonic but at the puncture, whose neighbourhood it spoils. In the stereographic
chart from the opposite pole that neighbourhood is an ordinary one: holding the rest of the sphere, the map is solved
for there, then for the rest in the other chart, and so on. The two charts overlap, and after three rounds the angles
do not change any more (H. A. Schwarz 1870; each round is two harmonic extensions).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..operators.dirichlet import DirichletProblem
from ..operators.edge_laplacian import EdgeLaplacian
from ..progress import Progress
from .centring import unit
from .energy import SphereEnergy
from .stereographic import from_plane, to_plane

__all__ = ["TwoCharts"]

Real = NDArray[np.float64]

OVERLAP = 0.3  # height of the circle that bounds each chart, beyond the equator
ROUNDS = 3
FEWEST = 3  # vertices held in a chart
TURN = np.array([1.0, -1.0, -1.0])  # exchanges the poles


class TwoCharts:
    """The Laplacian factorized in a chart of the north and in one of the south.

    Parameters
    ----------
    laplacian : EdgeLaplacian
    x : (n, 3) float64
        A map with the surface's area in balance, its puncture at the north pole; it tells what lies in which chart.
    points : (n, 3) float64
        The surface's vertices, which tell the order of elimination.

    Attributes
    ----------
    usable : bool
        Whether neither chart holds next to nothing.
    """

    def __init__(self, laplacian: EdgeLaplacian, x: Real, points: Real, backend: str, progress: Progress) -> None:
        self._laplacian, self._progress = laplacian, progress
        held = [np.flatnonzero(x[:, 2] <= -OVERLAP), np.flatnonzero(x[:, 2] >= OVERLAP)]
        self.usable = min(len(h) for h in held) >= FEWEST
        self._problems: list[DirichletProblem] = []
        for k, vertices in enumerate(held if self.usable else []):
            progress("schwarz", 0.4 * k)
            self._problems.append(DirichletProblem(laplacian, vertices, len(x), points=points, backend=backend))

    def alternated(self, x: Real) -> Real:
        """Positions (n, 3), harmonic in either chart."""
        north, south = self._problems
        for k in range(ROUNDS):
            self._progress("schwarz", 0.8 + 0.2 * k / ROUNDS)
            # The north is solved for turned to the south, so that it lies around 0 of the plane.
            x = from_plane(north.extend(to_plane((x * TURN)[north.boundary]))) * TURN
            x = from_plane(south.extend(to_plane(x[south.boundary])))
        return unit(x)

    def relaxed(self, x: Real, corners: NDArray[np.int32]) -> Real:
        """Positions nearer to the least conformal energy: a step against its gradient in each chart.

        The charts' maps are harmonic in the plane; the energy is that of the polyhedron on the sphere. Their difference
        is all over the surface and small, and goes with one step preconditioned by the factorizations at hand.
        """
        for problem in self._problems:
            energy = SphereEnergy(self._laplacian, corners, x)
            step = np.zeros_like(x)
            step[problem.interior] = -problem.solve(np.ascontiguousarray(energy.gradient[problem.interior]))
            x = unit(x + energy.tangent(step))
        return x
