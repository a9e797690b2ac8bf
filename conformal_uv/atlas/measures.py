"""The harmonic measures and boundary angles of many disks, as `disk.harmonic_measure` finds them for one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..disk.harmonic_measure import ALIKE, MOST_OF_ONE, NEAR_PEAK, NOTHING
from ..mesh.distinguished import distinguished
from ..mesh.geometry import TriangleGeometry, triangle_geometry
from ..mesh.halfedges import half_edges
from ..mesh.subdivide import split_edges
from ..operators.areas import lumped_areas
from ..operators.dirichlet import DirichletProblem
from ..options import Laplacian
from .block_laplacian import block_laplacian
from .disks import Disks, neighbours, places
from .loop_rows import loop_rows

__all__ = ["Measures", "measures"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]
Bools = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Measures:
    """What `CentredMeasure` is for one disk.

    Attributes
    ----------
    centre : (c,) int64
        -1 where there is none.
    vertex_measure, theta : (nb,) float64
        At the boundary vertices of all disks.
    found : (c,) bool
        Of which disks that is beyond doubt.
    """

    centre: Ints
    vertex_measure: Real
    theta: Real
    found: Bools


class _Part(NamedTuple):
    """Triangles of some disks and the Dirichlet problem of their boundaries."""

    V: Real
    corners: NDArray[np.int32]
    geometry: TriangleGeometry
    of_vertex: Ints
    problem: DirichletProblem


class _Peaks(NamedTuple):
    """Where torsion functions are largest: the vertex (c,), -1 where there is none, and the weights (n,) of that
    vertex alone and of those around it, each of sum 1."""

    vertex: Ints
    alone: Real
    around: Real


def measures(disks: Disks, problem: DirichletProblem, backend: str) -> Measures:
    """Seen from the peaks of the torsion functions, on copies with split chords where an edge would get nothing."""
    lengths = _lengths(disks)
    whole = _Part(disks.V, disks.corners, disks.geometry, disks.of_vertex, problem)
    peaks = _peaks(whole, len(disks))
    measure, middle = _seen(problem, peaks)
    theta, found = _angles(measure, lengths, disks.first_boundary)
    found &= peaks.vertex >= 0
    triangles = np.flatnonzero(~found & (np.diff(disks.first_vertex) == 3))
    if len(triangles):
        at = places(disks.first_boundary, triangles)
        middle[at], theta[at] = 1.0 / 3.0, np.tile(2.0 * np.pi / 3.0 * np.arange(3.0), len(triangles))
        found[triangles] = True
    rest = np.flatnonzero(~found)
    if len(rest):
        own = places(disks.first_boundary, rest)
        count = np.diff(disks.first_boundary)[rest]
        fine, fine_middle = _seen_on_copies(disks, rest, peaks, backend)
        first = np.concatenate((np.zeros(1, dtype=np.int64), np.cumsum(count)))
        theta[own], found[rest] = _angles(fine, lengths[own], first)
        bad = np.add.reduceat((measure[own] < 0.0) | (middle[own] < 0.0), first[:-1], dtype=np.int64) > 0
        middle[own] = np.where(np.repeat(bad | (peaks.vertex[rest] < 0), count), fine_middle, middle[own])
    centre = peaks.vertex.copy()
    _balance(middle, theta, centre, disks.first_boundary)
    return Measures(centre, middle, theta, found)


def _lengths(disks: Disks) -> Real:
    """Of the boundary edge from each boundary vertex to the next."""
    ahead, _ = neighbours(disks.first_boundary)
    return np.linalg.norm(disks.V[disks.loop[ahead]] - disks.V[disks.loop], axis=1)


def _peaks(part: _Part, count: int) -> _Peaks:
    n = len(part.V)
    vertex = np.full(count, -1, dtype=np.int64)
    alone, around = np.zeros(n), np.zeros(n)
    inside = part.problem.interior
    if not len(inside):
        return _Peaks(vertex, alone, around)
    owner = part.of_vertex[inside]
    order = np.argsort(owner, kind="stable")  # vertices that were put into edges come last
    inside, owner = inside[order], owner[order]
    starts = np.flatnonzero(np.diff(owner, prepend=-1))
    areas = lumped_areas(part.geometry, part.corners, n)[part.problem.interior]
    torsion = part.problem.solve(areas)[order]
    areas = areas[order]
    size = np.diff(np.append(starts, len(owner)))
    most = np.maximum.reduceat(torsion, starts)
    largest = np.maximum.reduceat(np.abs(torsion), starts)
    high = np.flatnonzero(torsion >= np.repeat(most - ALIKE * largest, size))
    here = owner[starts]
    alike = np.bincount(owner[high], minlength=count)
    vertex[owner[high]] = inside[high]
    for disk in np.flatnonzero(alike > 1).tolist():
        vertex[disk] = _distinguished(part, disk, inside[high[owner[high] == disk]])
    weights = areas * np.maximum(torsion - NEAR_PEAK * np.repeat(most, size), 0.0)
    total = np.add.reduceat(weights, starts)
    total[~(most > 0.0)] = 0.0
    shared = np.repeat(total, size)
    around[inside] = np.divide(weights, shared, out=np.zeros(len(weights)), where=shared > 0.0)
    alone[vertex[here]] = 1.0
    lonely = vertex[here[total == 0.0]]
    around[lonely] = 1.0
    return _Peaks(vertex, alone, around)


def _distinguished(part: _Part, disk: int, candidates: Ints) -> int:
    own = np.flatnonzero(part.of_vertex == disk)
    number = np.full(len(part.V), -1, dtype=np.int32)
    number[own] = np.arange(len(own), dtype=np.int32)
    faces = number[part.corners[:, part.of_vertex[part.corners[0]] == disk]]
    return int(own[distinguished(part.V[own], faces, number[candidates].astype(np.int64))])


def _seen(problem: DirichletProblem, peaks: _Peaks) -> tuple[Real, Real]:
    """Harmonic measures (nb,) seen from the peaks, and in the mean from around them."""
    poles = np.column_stack((peaks.alone, peaks.around))[problem.interior]
    one, other = -(problem.Lbi @ problem.solve(poles)).T
    return one, other


def _angles(measure: Real, lengths: Real, first: Ints) -> tuple[Real, Bools]:
    """Boundary angles as `angles_of_measure` has them, and of which disks (c,) they increase."""
    on_edge = _spread(measure, lengths, first)
    theta, found = np.zeros(len(measure)), np.zeros(len(first) - 1, dtype=bool)
    for rows in loop_rows(first):
        total = np.cumsum(on_edge[rows.at], axis=1)
        some = total[:, -1] > 0.0
        part = total[:, :-1] / np.where(some, total[:, -1], 1.0)[:, None]
        angle = 2.0 * np.pi * np.column_stack((np.zeros(len(part)), part))
        theta[rows.at] = angle
        found[rows.disk] = some & (np.diff(angle, append=2.0 * np.pi) > 0.0).all(axis=1)
    return theta, found


def _spread(measure: Real, lengths: Real, first: Ints) -> Real:
    """What each boundary edge gets of the measure of the vertices that bear any, up to a factor for each disk."""
    ahead, behind = neighbours(first)
    bearing = np.flatnonzero((measure > 0.0) & (measure > NOTHING * np.maximum(measure[behind], measure[ahead])))
    count = np.diff(first)
    of_boundary = np.repeat(np.arange(len(count)), count)
    per_disk = np.bincount(of_boundary[bearing], minlength=len(count))
    out = lengths.copy()
    some = np.flatnonzero(per_disk)
    if not len(some):
        return out
    begin = np.concatenate((np.zeros(1, dtype=np.int64), np.cumsum(per_disk)))  # of each disk among those that bear
    lead = np.zeros(len(count), dtype=np.int64)  # the first of each disk, counted from where its boundary begins
    lead[some] = bearing[begin[some]] - first[some]
    own = places(first, some)
    owner = of_boundary[own]
    turned = first[owner] + (own - first[owner] + lead[owner]) % count[owner]  # each boundary from its first on
    at = np.searchsorted(own, bearing - lead[of_boundary[bearing]])
    stretch = np.add.reduceat(lengths[turned], at)  # from each to the next
    after, before = neighbours(np.append(begin[some], len(bearing)))
    around = stretch + stretch[before]
    density = measure[bearing] / np.where(around > 0.0, around, 1.0)
    density = density + density[after]
    out[turned] = lengths[turned] * np.repeat(density, np.diff(at, append=len(own)))
    return out


def _seen_on_copies(disks: Disks, rest: Ints, peaks: _Peaks, backend: str) -> tuple[Real, Real]:
    """Measures as `_seen`, on copies of some disks with their chords split and weights that are not negative."""
    vertices = places(disks.first_vertex, rest)
    number = np.full(disks.n, -1, dtype=np.int32)
    number[vertices] = np.arange(len(vertices), dtype=np.int32)
    corners = number[disks.corners[:, places(disks.first_face, rest)]]
    loop = number[disks.loop[places(disks.first_boundary, rest)]].astype(np.int64)
    local = np.zeros(len(disks), dtype=np.int64)
    local[rest] = np.arange(len(rest))
    of_vertex = local[disks.of_vertex[vertices]]
    edges = half_edges(corners, len(vertices))
    on_boundary = np.zeros(len(vertices), dtype=bool)
    on_boundary[loop] = True
    chords = np.flatnonzero((edges.count == 2) & on_boundary[edges.lo] & on_boundary[edges.hi])
    V, corners = split_edges(disks.V[vertices], corners, edges, chords)
    of_vertex = np.concatenate((of_vertex, of_vertex[edges.lo[chords]]))
    edges, geometry = half_edges(corners, len(V)), triangle_geometry(V, corners)
    laplacian, _ = block_laplacian(corners, edges, geometry, of_vertex, len(rest), Laplacian.AUTO)
    problem = DirichletProblem(laplacian, loop, len(V), backend=backend)
    more = np.zeros(len(chords))
    known = peaks.vertex[rest] >= 0
    alone, around = (np.concatenate((weights[vertices], more)) for weights in peaks[1:])
    if not known.all():
        own = _peaks(_Part(V, corners, geometry, of_vertex, problem), len(rest))
        alone, around = np.where(known[of_vertex], alone, own.alone), np.where(known[of_vertex], around, own.around)
    return _seen(problem, _Peaks(peaks.vertex[rest], alone, around))


def _balance(middle: Real, theta: Real, centre: Ints, first: Ints) -> None:
    """Let arcs serve as measure where one boundary vertex has about half of it, without a centre there."""
    most, total = np.maximum.reduceat(middle, first[:-1]), np.add.reduceat(middle, first[:-1])
    for rows in loop_rows(first, np.flatnonzero(~((most < MOST_OF_ONE) & (total > 0.5)))):
        arcs = np.diff(theta[rows.at], append=2.0 * np.pi) / (4.0 * np.pi)
        middle[rows.at] = arcs + np.roll(arcs, 1, axis=1)
        centre[rows.disk] = -1
