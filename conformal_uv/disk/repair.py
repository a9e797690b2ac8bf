"""Folds mended where they are: patches of vertices placed at means of their neighbours by positive weights.

The weights are the map's own mean value weights, which hold unfolded parts where they are. Folds near one another
share a patch; each patch grows by itself while it does not help, and is put back where it never does. No fold is
mended at the price of the whole map.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..errors import SolverError
from ..mesh.stars import faces_at
from ..operators.mean_value import NeighbourMeans, positive_mean_value_matrix
from ..operators.moebius import Moebius
from ..operators.nearby_maps import NearbyMaps
from ..operators.orientation_sign import flipped_faces
from ..progress import Progress
from .placement import inside_disk

__all__ = ["Repair", "recentred", "repair_cost", "repaired"]

Complex = NDArray[np.complex128]
Faces = NDArray[np.int64]

RINGS = (1, 2, 4, 8, 16)  # of the patch around a fold


@dataclass(frozen=True)
class Repair:
    """What was done to the folds and what it cost.

    Attributes
    ----------
    flipped_before, flipped_after : int
        Faces with non-positive area, those too small for doubles included.
    moved_vertices : int
    angle_mean_before, angle_mean_after : float
        Mean angle error over all corners, degrees.
    """

    flipped_before: int
    flipped_after: int
    moved_vertices: int
    angle_mean_before: float
    angle_mean_after: float


def repair_cost(maps: NearbyMaps, before: Complex, after: Complex, folds: Faces, folds_after: Faces) -> Repair:
    """What the repair of positions `before`, with these folds, to `after` did."""
    return Repair(
        flipped_before=len(folds),
        flipped_after=len(folds_after),
        moved_vertices=int(np.count_nonzero(after != before)),
        angle_mean_before=maps.angle_mean(before),
        angle_mean_after=maps.angle_mean(after),
    )


def repaired(
    corners: NDArray[np.int32],
    z: Complex,
    movable: NDArray[np.bool_],
    folds_of: Callable[[Complex], Faces],
    progress: Progress,
) -> Complex:
    """Positions with fewer folds; z itself where it has none, or none that a patch around it mends.

    Parameters
    ----------
    corners : (3, m) int32
    z : (n,) complex128
        Positions in the plane.
    movable : (n,) bool
        Vertices that patches may take in; boundary vertices are none.
    folds_of : callable
        The faces folded at positions.
    """
    folds = folds_of(z)
    for number, rings in enumerate(RINGS):
        if not len(folds):
            break
        progress("repair", number / len(RINGS))
        patch = _ball(corners, folds, rings, len(z)) & movable
        if not patch.any():
            continue
        try:
            moved = _untangled(z, corners, patch, folds)
        except SolverError:
            continue
        z = _where_better(corners, patch, z, folds, moved, folds_of(moved))
        folds = folds_of(z)
    return z


def _where_better(
    corners: NDArray[np.int32], patch: NDArray[np.bool_], z: Complex, folds: Faces, moved: Complex, left: Faces
) -> Complex:
    """z, in each connected part of the patch that has fewer folds after it was moved as it is then."""
    at = np.flatnonzero(patch)
    number = np.full(len(z), -1, dtype=np.int64)
    number[at] = np.arange(len(at))
    place = number[corners.take(faces_at(corners, patch), axis=1)]
    sides = [(place[k], place[k - 1]) for k in range(3)]
    first, second = (np.concatenate(ends) for ends in zip(*sides, strict=True))
    both = (first >= 0) & (second >= 0)
    graph = coo_array((np.ones(both.sum(), dtype=np.int8), (first[both], second[both])), shape=(len(at), len(at)))
    parts, part = connected_components(graph, directed=False)
    before, after = (_folds_of_parts(number[corners.take(faces, axis=1)], part, parts) for faces in (folds, left))
    out = z.copy()
    taken = at[(after < before)[part]]
    out[taken] = moved[taken]
    return out


def _folds_of_parts(place: NDArray[np.int64], part: NDArray[np.integer], parts: int) -> NDArray[np.int64]:
    """How many faces each part has, by the places (3, k) of their corners among the vertices of all parts, or -1."""
    last = place.max(axis=0)
    return np.bincount(part[last[last >= 0]], minlength=parts)


def recentred(z: Complex, center: int | None, corners: NDArray[np.int32]) -> Complex:
    """z with the vertex that was at 0 back there, where that can be without folding anything."""
    if center is None or z[center] == 0.0 or not abs(z[center]) < 1.0 or len(flipped_faces(z, corners)):
        return z
    on_circle = np.abs(z) >= 1.0 - 1e-12
    moved = Moebius.to_zero(complex(z[center]), 1.0)(z)  # 1 is where the boundary vertex is, and stays
    moved[on_circle] *= np.abs(z[on_circle]) / np.abs(moved[on_circle])  # sharpened ears stay so
    moved = inside_disk(moved)
    moved[z == 1.0], moved[center] = 1.0, 0.0
    return z if len(flipped_faces(moved, corners)) else moved


def _ball(corners: NDArray[np.int32], faces: NDArray[np.int64], rings: int, n: int) -> NDArray[np.bool_]:
    """Vertices within so many rings of the faces."""
    near = np.zeros(n, dtype=bool)
    near[corners[:, faces]] = True
    for _ in range(rings):
        near[corners.take(faces_at(corners, near), axis=1)] = True
        if near.all():
            break
    return near


def _untangled(z: Complex, corners: NDArray[np.int32], patch: NDArray[np.bool_], folds: Faces) -> Complex:
    """z with the patch placed by its positive mean value weights."""
    folded = np.zeros(len(z), dtype=bool)
    folded[corners[:, folds]] = True
    faces = faces_at(corners, patch)
    return NeighbourMeans(positive_mean_value_matrix(z, corners, faces, folded), np.flatnonzero(patch)).placed(z)
