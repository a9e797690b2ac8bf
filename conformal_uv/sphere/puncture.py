"""A closed surface opened at a vertex, so that the disk's map can begin the sphere's."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..disk.gauge import CentreGauge
from ..disk.harmonic_measure import centred_measure
from ..mesh.distinguished import distinguished
from ..mesh.surface import Surface
from ..operators.areas import lumped_areas
from ..operators.dirichlet import DirichletProblem
from ..operators.edge_laplacian import edge_laplacian
from ..progress import Progress
from .stereographic import from_plane

__all__ = ["linear_sphere", "most_regular_vertex", "punctures"]

Real = NDArray[np.float64]

DEGREE_PENALTY = np.radians(20.0)  # for each edge more or less than six
NEARLY = np.radians(20.0)  # of regularity, that a vertex far from the most regular one may lack
DECIMALS = 6  # of radians; what differs by less is equal but for rounding


def punctures(surface: Surface, most: int) -> list[int]:
    """Vertices whose stars are like six equilateral triangles, the first the most regular, the others far from it.

    A star is what the linear map can not see; a sliver's corner there would spoil the whole map. Among vertices equal
    but for rounding it is the flattest, and among those the one that `distinguished` tells.
    """
    angle = np.arctan2(surface.geometry.double_area, surface.geometry.dot)
    deviation = np.abs(angle - np.pi / 3.0).max(axis=0)
    worst = np.zeros(surface.n)
    for corner in surface.corners:
        np.maximum.at(worst, corner, deviation)
    place = surface.corners.reshape(-1)
    degree = np.bincount(place, minlength=surface.n)
    defect = 2.0 * np.pi - np.bincount(place, weights=angle.reshape(-1), minlength=surface.n)
    irregular = np.round(worst + DEGREE_PENALTY * np.abs(degree - 6), DECIMALS)
    flatness = np.round(np.abs(defect), DECIMALS)
    best = np.flatnonzero(irregular == irregular.min())
    best = best[flatness[best] == flatness[best].min()]
    found = [distinguished(surface.V, surface.corners, best)]
    regular = np.flatnonzero(irregular <= irregular.min() + NEARLY)
    near = np.full(len(regular), np.inf)
    while len(found) < most:
        near = np.minimum(near, np.linalg.norm(surface.V[regular] - surface.V[found[-1]], axis=1))
        farthest = near.max()
        if not farthest > 0.0:
            break
        found.append(distinguished(surface.V, surface.corners, regular[near >= (1.0 - 1e-9) * farthest]))
    return found


def most_regular_vertex(surface: Surface) -> int:
    """The first of `punctures`."""
    return punctures(surface, 1)[0]


def linear_sphere(surface: Surface, vertex: int, laplacian: str, backend: str, progress: Progress) -> Real:
    """Positions (n, 3) on the unit sphere from one factorization.

    The surface without the star of the vertex goes to the disk by harmonic measure, is scaled so that
    half of its area lies within the unit circle, and goes to the sphere by stereographic projection; the vertex
    itself to the pole.
    """
    disk, rest = surface.without_vertex(vertex)
    progress("assembly", 0.0)
    edges = edge_laplacian(disk.corners, disk.edges, disk.geometry, disk.n, laplacian)
    problem = DirichletProblem(edges, disk.loops[0], disk.n, points=disk.V, backend=backend, progress=progress)
    progress("linear", 0.0)
    measure = centred_measure(disk, problem)
    theta = CentreGauge(measure.vertex_measure, measure.theta).restore(measure.theta)
    z = problem.extend(np.exp(1j * theta))
    z /= _half_area_radius(np.abs(z), lumped_areas(disk.geometry, disk.corners, disk.n))
    xyz = np.empty((surface.n, 3))
    xyz[rest] = from_plane(z)
    xyz[vertex] = (0.0, 0.0, 1.0)
    return xyz


def _half_area_radius(radius: Real, area: Real) -> float:
    """The radius within which half of the area lies."""
    order = np.argsort(radius)
    within = np.cumsum(area[order])
    half = radius[order[np.searchsorted(within, 0.5 * within[-1])]]
    return float(half) if half > 0.0 else 1.0
