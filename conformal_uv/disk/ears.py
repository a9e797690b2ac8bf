"""Ears, faces of three neighbouring boundary vertices, where rounding flattens the arcs under them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.stars import faces_among
from ..operators.orientation_sign import collapsed_faces, orientation_signs

__all__ = ["doubtful_faces", "with_sharp_ears"]

Complex = NDArray[np.complex128]
Ints = NDArray[np.int64]

DOUBTFUL_ARC = 1e-7  # up to which an ear's height is some rounding errors, and chance may have wound it rightly
DEPTHS = 2.0 ** np.arange(-48, -42)  # of an ear's sides below its tip: from well over the circle's rounding
DEEPEST = 9e-13  # below the circle
LEANING = 3.0  # times the depth of the tip


def doubtful_faces(z: Complex, corners: NDArray[np.int32], loop: Ints) -> Ints:
    """Faces that are folded, or of which only rounding could say that they are not.

    Some are flat; others are ears, faces of three neighbouring boundary vertices, on arcs of next to no height.
    """
    on_boundary = np.zeros(len(z), dtype=bool)
    on_boundary[loop] = True
    ears = faces_among(corners, on_boundary)
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
    if not ears.size:
        return z
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
