"""Embeddings where a map folds: boundaries that doubles can tell apart, and positive weights.

Every disk has an embedding with its boundary on the circle (Tutte 1963). What folds a map is that crowded boundary
vertices round to one point, or to an arc whose height is lost to rounding, and that an original triangle is none of the
intrinsic Delaunay triangulation. Mending any of it costs angles, so the dearer way is taken only where the cheaper one
does not do; nothing is cheaper than what stays within the rounding of the circle.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import SolverError
from ..mesh.surface import Surface
from ..operators.angle_mean import AngleMean
from ..operators.dirichlet import DirichletProblem
from ..operators.mean_value import NeighbourMeans, surface_mean_value_matrix
from ..operators.orientation_sign import collapsed_faces, flipped_faces, orientation_signs
from ..options import Repair
from ..progress import Progress
from .placement import inside_disk
from .repair import repaired

__all__ = ["doubtful_faces", "unfolded", "with_distinct_boundary", "with_sharp_ears"]

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]
Ints = NDArray[np.int64]

# Radians: an ear's height over its chord is the square of its arc over 8, and doubles near 1 are 1e-16 apart.
EAR_ARC = 3e-8
DOUBTFUL_ARC = 1e-7  # up to which an ear's height is some rounding errors, and chance may have wound it rightly
SMALLEST_ARC = 1e-15  # that neighbours on the circle keep; two doubles near 1 are told apart from 2e-16 on
DEPTHS = 2.0 ** np.arange(-48, -42)  # of an ear's sides below its tip: from well over the circle's rounding
DEEPEST = 9e-13  # below the circle
LEANING = 3.0  # times the depth of the tip
SHARES = (0.0, 1e-13, 1e-12, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0)  # of equal spacing
MOST_MENDED = 0.01  # of the faces; where more are folded, local repair would move everything anyway
ROUNDS = 4  # of widening ears
DEAR = 0.5  # degrees of mean angle error that `repair="auto"` does not pay
CHEAP = 0.02  # degrees; nobody looks for less


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
    folds: Ints,
    fixed: Ints,
    repair: Repair,
    progress: Progress,
) -> Complex:
    """Positions with the fewest folds that the repair may pay for, of these with the least angle error; or z itself.

    In the order of their cost: ears sharpened within the rounding of the circle, patches around folds moved
    (`repaired`), boundaries that take a growing share of equal spacing, extended by the Laplacian at hand and by the
    surface's mean value weights, which are positive.

    Parameters
    ----------
    z : (n,) complex128
        A map with the boundary on the circle in order; crowded vertices may coincide.
    folds : (k,) int64
        The faces folded there, and those of which only rounding could say that they are not.
    fixed : (f,) int64
        Boundary vertices that stay where they are, at least one.
    repair : Repair
        `auto` pays half a degree of mean angle error, `always` whatever it takes.
    """
    angles = AngleMean(surface, z)
    best = start = _Tried(z, folds, angles.first)
    most = start.angle_mean + DEAR if repair is Repair.AUTO else np.inf
    crowded = len(folds) > MOST_MENDED * surface.m  # there an embedding may well have less angle error
    folded = len(flipped_faces(z, surface.corners))
    progress("repair", 0.0)
    for tried in _ways(surface, problem, z, folds, fixed, angles, progress):
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
    folds: Ints,
    fixed: Ints,
    angles: AngleMean,
    progress: Progress,
) -> Iterator[_Tried]:
    loop, corners = problem.boundary, surface.corners
    sharp = _tried(surface, angles, with_sharp_ears(z, corners, loop, np.union1d(folds, flipped_faces(z, corners))))
    yield sharp
    if len(sharp.folds):
        yield _tried(surface, angles, _mended(surface, loop, sharp.z, progress))
    means: list[NeighbourMeans] = []

    def by_mean_values(zb: Complex) -> Complex:
        if not means:
            means.append(NeighbourMeans(surface_mean_value_matrix(surface), problem.interior))
        given = np.zeros(surface.n, dtype=np.complex128)
        given[loop] = zb
        return means[0].placed(given)

    boundary = _Boundary(z[loop], np.flatnonzero(np.isin(loop, fixed)))
    for number, share in enumerate(SHARES):
        progress("repair", number / len(SHARES))
        for extend in (problem.extend, by_mean_values):
            try:
                yield _respaced(surface, loop, boundary, boundary.shared(share), extend, angles, progress)
            except SolverError:
                continue


def _tried(surface: Surface, angles: AngleMean, z: Complex) -> _Tried:
    z = inside_disk(z)
    return _Tried(z, flipped_faces(z, surface.corners), angles.of(z))


class _Boundary:
    """Points of the circle in order, as arcs from each to the next; some of them stay where they are.

    Parameters
    ----------
    zb : (nb,) complex128
    fixed : (f,) int64
        Places in zb, ascending, at least one.
    """

    def __init__(self, zb: Complex, fixed: Ints) -> None:
        self._zb, self._fixed = zb, fixed
        self.arcs = np.maximum(np.angle(np.roll(zb, -1) / zb), 0.0)
        if not self.arcs.any():
            self.arcs += 1.0
        held = np.angle(np.roll(zb[fixed], -1) / zb[fixed]) % (2.0 * np.pi)
        self._stretch = np.where(held > 0.0, held, 2.0 * np.pi)  # a single one: all around
        self.arcs = self.fitted(self.arcs)

    def shared(self, share: float) -> Real:
        """Arcs with this share of equal spacing."""
        return self.fitted((1.0 - share) * self.arcs + share * 2.0 * np.pi / len(self.arcs))

    def fitted(self, arcs: Real) -> Real:
        """Arcs scaled between each two fixed points to what lies between them."""
        first = int(self._fixed[0])
        turned = np.roll(arcs, -first)
        begin = self._fixed - first
        total = np.add.reduceat(turned, begin)
        count = np.diff(begin, append=len(arcs))
        scale = np.repeat(self._stretch / np.where(total > 0.0, total, 1.0), count)
        return np.asarray(np.roll(turned * scale, first))

    def points(self, arcs: Real) -> Complex:
        """Points with these arcs between them, the fixed ones where they were.

        Angles are summed from both sides of each fixed point, which rounds the smaller ones less.
        """
        first = int(self._fixed[0])
        out = self._zb.copy()
        begin = np.append(self._fixed, first + len(arcs))
        for start, end in zip(begin[:-1].tolist(), begin[1:].tolist(), strict=True):
            here = np.arange(start, end) % len(arcs)
            ahead = np.concatenate(([0.0], np.cumsum(arcs[here])))
            back = np.concatenate((np.cumsum(arcs[here][::-1])[::-1], [0.0]))
            near_start = ahead[:-1] <= back[:-1]
            turned = np.where(
                near_start,
                self._zb[start % len(arcs)] * np.exp(1j * ahead[:-1]),
                self._zb[end % len(arcs)] * np.exp(-1j * back[:-1]),
            )
            out[here[1:]] = (turned / np.abs(turned))[1:]
        return out


def with_distinct_boundary(z: Complex, loop: Ints, fixed: Ints) -> Complex:
    """z with neighbours on the circle that had rounded to one point moved apart by what doubles tell."""
    zb = z[loop]
    if (zb != np.roll(zb, -1)).all() and (np.angle(np.roll(zb, -1) / zb) > 0.0).all():
        return z
    boundary = _Boundary(zb, np.flatnonzero(np.isin(loop, fixed)))
    out = z.copy()
    out[loop] = boundary.points(boundary.fitted(np.maximum(boundary.arcs, SMALLEST_ARC)))
    return out


def doubtful_faces(z: Complex, corners: NDArray[np.int32], loop: Ints) -> Ints:
    """Faces that are folded, or of which only rounding could say that they are not.

    Some are flat; others are ears, faces of three neighbouring boundary vertices, on arcs of next to no height.
    """
    place = np.full(len(z), -1, dtype=np.int64)
    place[loop] = np.arange(len(loop))
    at = place[corners]
    ears = np.flatnonzero((at >= 0).all(axis=0))
    a, b, c = (z[corner] for corner in corners[:, ears])
    longest = np.maximum(np.maximum(np.abs(b - a), np.abs(c - b)), np.abs(a - c))
    return np.union1d(collapsed_faces(z, corners), ears[longest < DOUBTFUL_ARC])


def with_sharp_ears(z: Complex, corners: NDArray[np.int32], loop: Ints, folds: Ints) -> Complex:
    """z with the neighbours of folded ears' tips a little inside the circle, by less than 1e-12.

    The tip of an ear is a boundary vertex of one face. On an arc under 3e-8 the three corners of the face lie on one
    line but for rounding, and rounding alone has decided how it is wound. Where an ear leans on another one, its
    sides go deeper than those of that one.
    """
    on_boundary = np.zeros(len(z), dtype=bool)
    on_boundary[loop] = True
    ears = corners[:, folds]
    ears = ears[:, on_boundary[ears].all(axis=0)]
    levels = _levels(ears, np.bincount(corners.reshape(-1), minlength=len(z)))
    out, need = z, np.full(ears.shape[1], DEPTHS[0])
    for deepest in DEPTHS:
        depth = np.zeros(len(z))
        for here, tips, sides in levels:
            deeper = np.minimum(LEANING * depth[tips] + need[here], DEEPEST)
            for side in sides:
                np.maximum.at(depth, side, deeper)
        moved = np.flatnonzero(depth)
        out = z.copy()
        out[moved] = z[moved] / np.abs(z[moved]) * (1.0 - depth[moved])
        points = np.ascontiguousarray(out).view(np.float64).reshape(-1, 2)
        left = orientation_signs(points, ears) <= 0
        if not left.any():
            break
        need[left] = 2.0 * deepest
    return out


def _levels(ears: NDArray[np.int32], degree: Ints) -> list[tuple[Ints, Ints, Ints]]:
    """The ears (3, k) level by level: which they are, their tips (k,) and the two sides of each, (2, k).

    Vertices that are tips once the ears of the levels before are gone make the next level.
    """
    degree, left = degree.copy(), np.arange(ears.shape[1])
    levels = []
    while len(left):
        is_tip = degree[ears[:, left]] == 1
        ready = is_tip.sum(axis=0) == 1
        if not ready.any():
            break
        here = left[ready]
        which = np.argmax(is_tip[:, ready], axis=0)
        columns = np.arange(len(here))
        of_ear = ears[:, here].astype(np.int64)
        levels.append((here, of_ear[which, columns], np.stack([of_ear[(which + k) % 3, columns] for k in (1, 2)])))
        np.subtract.at(degree, of_ear.reshape(-1), 1)
        left = left[~ready]
    return levels


def _respaced(
    surface: Surface,
    loop: Ints,
    boundary: _Boundary,
    arcs: Real,
    extend: Callable[[Complex], Complex],
    angles: AngleMean,
    progress: Progress,
) -> _Tried:
    """The extension of one boundary, arcs of folded ears widened to what doubles resolve, after local repair."""
    corners = surface.corners
    place = np.full(surface.n, -1, dtype=np.int64)
    place[loop] = np.arange(len(loop))
    ears = np.flatnonzero((place[corners] >= 0).all(axis=0))
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
        z = _mended(surface, loop, z, progress)
    return _tried(surface, angles, z)


def _mended(surface: Surface, loop: Ints, z: Complex, progress: Progress) -> Complex:
    """Local repair of the interior."""
    inside = np.ones(surface.n, dtype=bool)
    inside[loop] = False
    return repaired(surface.corners, z, inside, lambda z: collapsed_faces(z, surface.corners), progress)


def _arcs_of(places: Ints, count: int) -> Ints:
    """The arcs between neighbours among the corners (3, k) of faces, places on a boundary of `count` vertices."""
    following = np.roll(places, -1, axis=0)
    arcs = np.where((following - places) % count == 1, places, -1)
    return np.unique(arcs[arcs >= 0])
