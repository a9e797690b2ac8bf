"""Embeddings where a map folds: boundaries that doubles can tell apart, and positive weights.

Every disk has an embedding with its boundary on the circle (Tutte 1963). What folds a map is that crowded boundary
vertices round to one point, or to an arc whose height is lost to rounding, and that an original triangle is none of the
intrinsic Delaunay triangulation. Mending any of it costs angles, so the dearer way is taken only where the cheaper one
does not do; nothing is cheaper than what stays within the rounding of the circle.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import islice
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import SolverError
from ..mesh.stars import faces_among
from ..mesh.surface import Surface
from ..operators.dirichlet import DirichletProblem
from ..operators.mean_value import NeighbourMeans, surface_mean_value_matrix
from ..operators.nearby_maps import NearbyMaps
from ..operators.orientation_sign import flipped_faces
from ..options import Repair
from ..progress import Progress
from .ears import with_sharp_ears
from .placement import inside_disk
from .repair import repaired
from .spacing import SMALLEST_ARC, CircleSpacing
from .untangling import untangled

__all__ = ["unfolded"]

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]
Ints = NDArray[np.int64]

# Radians: an ear's height over its chord is the square of its arc over 8, and doubles near 1 are 1e-16 apart.
EAR_ARC = 3e-8
SHARES = (0.0, 1e-13, 1e-12, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0)  # of equal spacing
MOST_MENDED = 0.01  # of the faces; where more are folded, local repair would move everything anyway
MOST_UNTANGLED = 0.2  # of the faces
ROUNDS = 4  # of widening ears
CHEAP = 0.02  # degrees; nobody looks for less
LARGE, PATIENCE = 200_000, 5  # faces, from where on `auto` tries no more ways than that, each over the whole surface


class _Tried(NamedTuple):
    """Positions z (n,), the faces folded there, and the mean angle error in degrees."""

    z: Complex
    folds: Ints
    angle_mean: float

    @property
    def rank(self) -> tuple[int, float]:
        """Less is better."""
        return len(self.folds), self.angle_mean


def unfolded(
    surface: Surface,
    problem: DirichletProblem,
    z: Complex,
    maps: NearbyMaps,
    doubtful: Ints,
    fixed: Ints,
    repair: Repair,
    progress: Progress,
) -> Complex:
    """Positions with the fewest folds that the repair may pay for, of these with the least angle error; or z itself.

    In the order of their cost: ears sharpened within the rounding of the circle, patches around folds moved
    (`repaired`) or optimised (`untangled`), boundaries that take a growing share of equal spacing, extended by the
    Laplacian at hand and by the surface's mean value weights, which are positive.

    Parameters
    ----------
    z : (n,) complex128
        A map with the boundary on the circle in order; crowded vertices may coincide.
    maps : NearbyMaps
        Of z.
    doubtful : (k,) int64
        The faces folded there, and those of which only rounding could say that they are not.
    fixed : (f,) int64
        Boundary vertices that stay where they are, at least one.
    repair : Repair
        `auto` pays half a degree of mean angle error, and on large meshes a few passes over the surface; `always`
        whatever it takes.
    """
    best = start = _Tried(z, doubtful, maps.angle_mean(z))
    most = start.angle_mean + repair.pays
    crowded = len(doubtful) > MOST_MENDED * surface.m  # there an embedding may well have less angle error
    folded = len(maps.flipped(z))
    progress("repair", 0.0)
    patience = PATIENCE if repair is Repair.AUTO and surface.m > LARGE and not crowded else None
    for tried in islice(_ways(surface, problem, z, maps, doubtful, fixed, progress), patience):
        if tried.angle_mean <= most and tried.rank < best.rank and len(tried.folds) <= folded:
            best = tried
        if not len(best.folds) and best.angle_mean <= start.angle_mean + CHEAP and not crowded:
            break
    progress("repair", 1.0)
    return z if best is start else best.z


def _ways(
    surface: Surface,
    problem: DirichletProblem,
    z: Complex,
    maps: NearbyMaps,
    doubtful: Ints,
    fixed: Ints,
    progress: Progress,
) -> Iterator[_Tried]:
    loop, corners = problem.boundary, surface.corners
    sharp = _tried(maps, with_sharp_ears(z, corners, loop, np.union1d(doubtful, maps.flipped(z))))
    yield sharp
    if len(sharp.folds):
        mended = _tried(maps, _mended(surface, loop, sharp.z, maps, progress))
        yield mended
        for start in (mended, sharp):
            if 0 < len(start.folds) <= MOST_UNTANGLED * surface.m:
                yield _tried(maps, _untangled(surface, loop, start.z, maps, problem.backend, progress))
    means: list[NeighbourMeans] = []

    def by_mean_values(zb: Complex) -> Complex:
        if not means:
            means.append(NeighbourMeans(surface_mean_value_matrix(surface), problem.interior))
        given = np.zeros(surface.n, dtype=np.complex128)
        given[loop] = zb
        return means[0].placed(given)

    boundary = CircleSpacing(z[loop], np.flatnonzero(np.isin(loop, fixed)))
    for number, share in enumerate(SHARES):
        progress("repair", number / len(SHARES))
        for extend in (problem.extend, by_mean_values):
            try:
                yield _respaced(
                    surface, loop, boundary, boundary.shared(share), extend, maps, problem.backend, progress
                )
            except SolverError:
                continue


def _tried(maps: NearbyMaps, z: Complex) -> _Tried:
    z = inside_disk(z)
    return _Tried(z, maps.flipped(z), maps.angle_mean(z))


def _respaced(
    surface: Surface,
    loop: Ints,
    boundary: CircleSpacing,
    arcs: Real,
    extend: Callable[[Complex], Complex],
    maps: NearbyMaps,
    backend: str,
    progress: Progress,
) -> _Tried:
    """The extension of one boundary, arcs of folded ears widened to what doubles resolve, after local repair."""
    corners = surface.corners
    place = np.full(surface.n, -1, dtype=np.int64)
    place[loop] = np.arange(len(loop))
    ears = faces_among(corners, place >= 0)
    for _ in range(ROUNDS):
        arcs = boundary.fitted(np.maximum(arcs, SMALLEST_ARC))
        z = extend(boundary.points(arcs))
        z = with_sharp_ears(z, corners, loop, flipped_faces(z, corners))
        folds = flipped_faces(z, corners)
        narrow = _arcs_of(place[corners[:, np.intersect1d(folds, ears)]], len(loop))
        narrow = narrow[arcs[narrow] < EAR_ARC]
        if not len(narrow):
            break
        arcs = arcs.copy()
        arcs[narrow] = EAR_ARC
    if 0 < len(folds) <= max(100, MOST_MENDED * surface.m):
        z = _mended(surface, loop, z, maps, progress)
        folds = flipped_faces(z, corners)
    if 0 < len(folds) <= MOST_UNTANGLED * surface.m:
        z = _untangled(surface, loop, z, maps, backend, progress)
    return _tried(maps, z)


def _mended(surface: Surface, loop: Ints, z: Complex, maps: NearbyMaps, progress: Progress) -> Complex:
    """Local repair of the interior."""
    return repaired(surface.corners, z, _interior(surface, loop), maps.collapsed, progress)


def _untangled(surface: Surface, loop: Ints, z: Complex, maps: NearbyMaps, backend: str, progress: Progress) -> Complex:
    return untangled(surface, z, _interior(surface, loop), maps.flipped, backend, progress)


def _interior(surface: Surface, loop: Ints) -> NDArray[np.bool_]:
    inside = np.ones(surface.n, dtype=bool)
    inside[loop] = False
    return inside


def _arcs_of(places: Ints, count: int) -> Ints:
    """The arcs between neighbours among the corners (3, k) of faces, places on a boundary of `count` vertices."""
    following = np.roll(places, -1, axis=0)
    arcs = np.where((following - places) % count == 1, places, -1)
    return np.unique(arcs[arcs >= 0])
