"""Restoring an embedding where original triangles came out folded.

Around the folds vertices are placed at means of their neighbours by positive weights: the map's own mean value weights,
which hold unfolded parts where they are. Where folds remain the patch grows; when it takes in the whole interior,
Tutte's theorem leaves no fold but those that doubles can not resolve. Uniform weights, which crowd the least, have
the last try.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from ..mesh.geometry import triangle_geometry
from ..mesh.surface import Surface
from ..operators.distortion import distortion_of
from ..operators.mean_value import NeighbourMeans, positive_mean_value_matrix
from ..operators.moebius import Moebius
from ..operators.orientation_sign import flipped_faces
from ..progress import Progress
from .placement import inside_disk

__all__ = ["Repair", "recentred", "repair_cost", "repaired", "unresolved_faces"]

Complex = NDArray[np.complex128]
Faces = NDArray[np.int64]

MOST_TRIED = 100  # collapsed faces
FIRST_RINGS = 1  # of the patch around a fold
RESOLUTION = 16.0 * np.finfo(np.float64).eps  # of a position in the disk, with a few operations behind it


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


def repair_cost(surface: Surface, before: Complex, after: Complex, folds: Faces, folds_after: Faces) -> Repair:
    """What the repair of positions `before`, with these folds, to `after` did."""
    angles = [distortion_of(surface.geometry, surface.corners, _points(z)).angle_mean for z in (before, after)]
    return Repair(
        flipped_before=len(folds),
        flipped_after=len(folds_after),
        moved_vertices=int(np.count_nonzero(after != before)),
        angle_mean_before=angles[0],
        angle_mean_after=angles[1],
    )


def unresolved_faces(z: Complex, corners: NDArray[np.int32], faces: NDArray[np.int64]) -> NDArray[np.int64]:
    """Those of the faces whose height in the disk is within the rounding of the positions."""
    shape = triangle_geometry(_points(z), corners[:, faces])
    longest = np.sqrt(shape.squared_lengths.max(axis=0, initial=0.0))
    return faces[shape.double_area <= RESOLUTION * np.maximum(longest, RESOLUTION)]


def repaired(
    surface: Surface, z: Complex, flipped: NDArray[np.int64], boundary: NDArray[np.int64], progress: Progress
) -> Complex:
    """Positions without folds, as far as doubles hold them; z itself where it has none.

    Parameters
    ----------
    z : (n,) complex128
        Positions in the unit disk, the boundary on the circle in order.
    flipped : (k,) int64
        The faces folded there.

    Returns
    -------
    (n,) complex128
    """
    corners, n = surface.corners, surface.n
    crowded = unresolved_faces(z, corners, flipped)
    if len(crowded) < MOST_TRIED:
        crowded = crowded[:0]  # few enough to try them too; crowding proper comes in great numbers
    folds = np.setdiff1d(flipped, crowded, assume_unique=True)
    if not len(folds):
        return z
    inside = np.ones(n, dtype=bool)
    inside[boundary] = False
    candidates = [(len(folds), z)]
    most = len(folds)
    rings, whole = FIRST_RINGS, False
    while len(folds) and not whole:
        progress("repair", min(0.99, 1.0 - len(folds) / (most + 1)))
        patch = _ball(corners, folds, rings, n) & inside
        whole = bool(patch[inside].all())
        moved = _untangled(z, corners, patch)
        left = np.setdiff1d(flipped_faces(moved, corners), crowded, assume_unique=True)
        if len(left) < len(folds):
            z, folds = moved, left
            candidates.append((len(folds), z))
        else:
            rings *= 2
    if len(folds) and inside.any():
        moved = NeighbourMeans(_adjacency(surface), np.flatnonzero(inside)).placed(candidates[0][1])
        left = np.setdiff1d(flipped_faces(moved, corners), crowded, assume_unique=True)
        candidates.append((len(left), moved))
    fewest, best = min(candidates, key=lambda candidate: candidate[0])
    if 2 * fewest > candidates[0][0]:  # little to be had for all the angles that it would cost
        best = candidates[0][1]
    return best


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
        near[corners[:, near[corners].any(axis=0)]] = True
        if near.all():
            break
    return near


def _untangled(z: Complex, corners: NDArray[np.int32], patch: NDArray[np.bool_]) -> Complex:
    """z with the patch placed by its positive mean value weights."""
    folded = np.zeros(len(z), dtype=bool)
    folded[corners[:, flipped_faces(z, corners)]] = True
    faces = np.flatnonzero(patch[corners].any(axis=0))
    return NeighbourMeans(positive_mean_value_matrix(z, corners, faces, folded), np.flatnonzero(patch)).placed(z)


def _adjacency(surface: Surface) -> csr_array:
    """Weight 1 between the two vertices of each edge."""
    lo, hi = surface.edges.lo, surface.edges.hi
    ends = np.concatenate((lo, hi)), np.concatenate((hi, lo))
    return csr_array((np.ones(2 * len(lo)), ends), shape=(surface.n, surface.n))


def _points(z: Complex) -> NDArray[np.float64]:
    return np.ascontiguousarray(z).view(np.float64).reshape(-1, 2)
