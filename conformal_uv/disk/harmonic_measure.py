"""The boundary angles of the Riemann map, read off the Green's function.

The Riemann map f with f(p) = 0 satisfies log |f| = G, the Green's function with its pole at p, so along the
boundary its angle advances by the flux of G: 2 pi times the harmonic measure seen from p.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..mesh.distinguished import distinguished
from ..mesh.geometry import TriangleGeometry, triangle_geometry
from ..mesh.halfedges import half_edges
from ..mesh.subdivide import split_edges
from ..mesh.surface import Surface
from ..operators.areas import lumped_areas
from ..operators.dirichlet import DirichletProblem
from ..operators.edge_laplacian import edge_laplacian

__all__ = ["CentredMeasure", "angles_of_measure", "balanced_measure", "centred_measure", "peak_weights"]

EFFORT = 4  # flips a face of the copy with chords split; thousands of chords side by side may ask for any number
MOST_OF_ONE = 0.49  # of the harmonic measure
NOTHING = 1e-12  # of a neighbour's measure: what is left of weights that cancel
ALIKE = 1e-9  # part of the torsion function's peak
NEAR_PEAK = 0.97  # of it, from where on a vertex counts as about the middle; on a flat disk, a thirtieth of the area


@dataclass(frozen=True, eq=False)
class CentredMeasure:
    """Harmonic measure of the boundary seen from a central vertex.

    Attributes
    ----------
    centre : int or None
        The interior vertex that it is seen from, None where there is no such vertex.
    vertex_measure : (nb,) float64
        The mean of the measures seen from the vertices about it, where the torsion function is near its peak; it sums
        to 1, and its mean of the boundary's positions is held at 0. So no vertex is snapped to, and a symmetric surface
        gets a symmetric map.
    theta : (nb,) float64
        Boundary angles, increasing from 0.
    """

    centre: int | None
    vertex_measure: NDArray[np.float64]
    theta: NDArray[np.float64]


def centred_measure(surface: Surface, problem: DirichletProblem) -> CentredMeasure:
    """Harmonic measure seen from the peak of the torsion function, and the boundary angles it gives.

    Chords (interior edges between two boundary vertices) stop the flux of piecewise linear functions: no boundary
    edge of a corner cut off by several of them would get any. Such a mesh, one without interior vertices, and one
    whose weights give negative flux, is measured on a copy with its chords split and weights that are not negative.
    """
    loop = problem.boundary
    lengths = np.linalg.norm(surface.V[np.roll(loop, -1)] - surface.V[loop], axis=1)
    peak, measure, middle = None, None, None
    if len(problem.interior):
        peak = torsion_peak(surface.V, surface.corners, surface.geometry, problem)
        measure, middle = peak.measures(problem)
        theta = angles_of_measure(measure, lengths)
        if (np.diff(theta, append=2.0 * np.pi) > 0.0).all():
            return balanced_measure(CentredMeasure(peak.vertex, middle, theta))
    elif surface.n == 3:
        return CentredMeasure(None, np.full(3, 1.0 / 3.0), 2.0 * np.pi / 3.0 * np.arange(3.0))
    V, corners = split_edges(surface.V, surface.corners, surface.edges, chord_edges(surface, loop))
    edges, geometry = half_edges(corners, len(V)), triangle_geometry(V, corners)
    laplacian = edge_laplacian(corners, edges, geometry, len(V), effort=EFFORT)
    refined = DirichletProblem(laplacian, loop, len(V), points=V, backend=problem.backend)
    seen = peak if peak is not None else torsion_peak(V, corners, geometry, refined)
    fine, fine_middle = seen.measures(refined)
    if measure is None or middle is None or (measure < 0.0).any() or (middle < 0.0).any():
        middle = fine_middle
    return balanced_measure(
        CentredMeasure(None if peak is None else peak.vertex, middle, angles_of_measure(fine, lengths))
    )


def balanced_measure(found: CentredMeasure) -> CentredMeasure:
    """The same, without a centre where one boundary vertex has about half of its measure.

    No map of the disk brings the image of such a vertex to 0. The arcs then serve as measure.
    """
    if found.vertex_measure.max() < MOST_OF_ONE and found.vertex_measure.sum() > 0.5:
        return found
    arcs = np.diff(found.theta, append=2.0 * np.pi) / (4.0 * np.pi)
    return CentredMeasure(None, arcs + np.roll(arcs, 1), found.theta)


class TorsionPeak(NamedTuple):
    """Where the torsion function (-laplacian t = 1, t = 0 on the boundary) is largest.

    `vertex` has the largest value, of some that are alike but for rounding the one that `distinguished` tells;
    `around` (k,) are the vertices with nearly as much, and `weights` (k,) of sum 1 how much of the surface each stands
    for and how near it comes.
    """

    vertex: int
    around: NDArray[np.int64]
    weights: NDArray[np.float64]

    def measures(self, problem: DirichletProblem) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Harmonic measures (nb,) seen from the vertex, and in the mean from those around it."""
        measure = problem.harmonic_measure(self.vertex)
        if len(self.around) == 1:
            return measure, measure
        return measure, problem.mean_measure(self.around, self.weights)


def torsion_peak(
    V: NDArray[np.float64], corners: NDArray[np.int32], geometry: TriangleGeometry, problem: DirichletProblem
) -> TorsionPeak:
    """From the surface and the factorized Laplacian."""
    areas = lumped_areas(geometry, corners, len(V))[problem.interior]
    torsion = problem.solve(areas)
    most = float(torsion.max())
    vertex = distinguished(V, corners, problem.interior[torsion >= most - ALIKE * np.abs(torsion).max()])
    weights = peak_weights(areas, torsion, most)
    near = np.flatnonzero(weights)
    if not len(near) or not most > 0.0:
        return TorsionPeak(vertex, np.array([vertex]), np.ones(1))
    return TorsionPeak(vertex, problem.interior[near], weights[near] / weights[near].sum())


def peak_weights(areas: NDArray[np.float64], torsion: NDArray[np.float64], most: float) -> NDArray[np.float64]:
    """How much of the surface interior vertices (ni,) stand for, and how near they come to the peak of the torsion."""
    return areas * np.maximum(torsion - NEAR_PEAK * most, 0.0)


def angles_of_measure(measure: NDArray[np.float64], lengths: NDArray[np.float64]) -> NDArray[np.float64]:
    """Angles of the boundary vertices from their harmonic measure.

    Each vertex shares its measure between the boundary on its two sides, as far as the next vertices that have any, in
    proportion to their lengths, and every stretch spreads what it gets evenly along itself; the running sum over the
    edges, times 2 pi, is the angle.

    Parameters
    ----------
    measure : (nb,)
    lengths : (nb,)
        Of the boundary edge from each vertex to the next.
    """
    beside = np.maximum(np.roll(measure, 1), np.roll(measure, -1))
    bearing = np.flatnonzero((measure > 0.0) & (measure > NOTHING * beside))
    on_edge = _spread(measure, lengths, bearing) if len(bearing) else lengths
    if not on_edge.any():  # all of it lost to rounding, on needles
        on_edge = lengths if lengths.any() else np.ones(len(lengths))
    total = np.cumsum(on_edge)
    return 2.0 * np.pi * np.concatenate(([0.0], total[:-1] / total[-1]))


def _spread(
    measure: NDArray[np.float64], lengths: NDArray[np.float64], bearing: NDArray[np.int64]
) -> NDArray[np.float64]:
    """What each boundary edge gets, up to a factor, of the measure of the vertices that bear any."""
    first = int(bearing[0])
    stretch = np.add.reduceat(np.roll(lengths, -first), bearing - first)  # from each to the next
    around = stretch + np.roll(stretch, 1)
    density = measure[bearing] / np.where(around > 0.0, around, 1.0)
    density += np.roll(density, -1)
    edges = np.diff(bearing, append=first + len(measure))
    return np.asarray(lengths * np.roll(np.repeat(density, edges), first))


def chord_edges(surface: Surface, loop: NDArray[np.int64]) -> NDArray[np.int64]:
    """Interior edges whose two vertices lie on the boundary."""
    on_boundary = np.zeros(surface.n, dtype=bool)
    on_boundary[loop] = True
    edges = surface.edges
    return np.flatnonzero((edges.count == 2) & on_boundary[edges.lo] & on_boundary[edges.hi])
