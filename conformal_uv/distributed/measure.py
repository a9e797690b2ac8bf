"""The centre of a surface spread over ranks, the harmonic measure seen from it, and the boundary angles it gives."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..disk.harmonic_measure import ALIKE, CentredMeasure, angles_of_measure, balanced_measure, peak_weights
from ..operators.areas import lumped_areas
from .checks import Boundary
from .dirichlet import DistributedDirichlet
from .distinguished import distinguished_vertex

__all__ = ["distributed_measure"]

Real = NDArray[np.float64]


class _Peak(NamedTuple):
    """The vertex of the torsion's peak, this rank's pole there, and its weights about it (ni,)."""

    vertex: int
    pole: Real
    weights: Real


def distributed_measure(problem: DistributedDirichlet, boundary: Boundary) -> CentredMeasure:
    """As `disk.harmonic_measure.centred_measure`; a mesh whose fluxes are lost to rounding is taken as it is."""
    points = boundary.points
    lengths = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    peak = _torsion_peak(problem)
    measure = problem.measure(peak.pole)
    middle = measure if peak.weights is peak.pole else problem.measure(peak.weights)
    return balanced_measure(CentredMeasure(peak.vertex, middle, angles_of_measure(measure, lengths)))


def _torsion_peak(problem: DistributedDirichlet) -> _Peak:
    """See `disk.harmonic_measure.torsion_peak`."""
    part, ranks = problem.part, problem.part.ranks
    areas = lumped_areas(part.geometry, part.corners, part.size)[problem.interior]
    torsion = problem.solve(areas)
    most = ranks.most(float(torsion.max(initial=-np.inf)))
    largest = ranks.most(float(np.abs(torsion).max(initial=0.0)))
    own = problem.interior[torsion >= most - ALIKE * largest]
    vertex = distinguished_vertex(part, ranks.indices(part.names(own)))
    pole = (part.names(problem.interior) == vertex).astype(np.float64)
    weights = peak_weights(areas, torsion, most)
    count, total = ranks.total(np.array([np.count_nonzero(weights), weights.sum()]))
    if count <= 1 or not most > 0.0:
        return _Peak(vertex, pole, pole)
    return _Peak(vertex, pole, weights / total)
