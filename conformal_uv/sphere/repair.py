"""Unfolding a map to the sphere in the plane: seen from a sound face, the rest of the sphere is a disk."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..disk.repair import repaired
from ..mesh.surface import Surface
from ..operators.orientation_sign import flipped_faces, inverted_faces
from ..progress import Progress
from .centring import turn_to_pole, unit
from .stereographic import from_plane, to_plane

__all__ = ["unfolded"]

Real = NDArray[np.float64]

MOST_TURNS = 30  # folds to project around


def unfolded(surface: Surface, x: Real, progress: Progress) -> Real:
    """Positions (n, 3) with fewer or no inverted faces; x itself where nothing was inverted or nothing helped.

    Around each fold in turn, the sphere is projected from the sound face farthest from it: that face becomes the
    convex outline of all others, and positive weights unfold them (Tutte 1963).
    """
    inverted = inverted_faces(x, surface.corners)
    for turn in range(MOST_TURNS):
        if turn >= len(inverted):
            break
        moved = _unfolded_about(surface, x, int(inverted[turn]), inverted, progress)
        left = inverted_faces(moved, surface.corners)
        if len(left) < len(inverted):
            x, inverted = moved, left
    return x


def _unfolded_about(surface: Surface, x: Real, fold: int, inverted: NDArray[np.int64], progress: Progress) -> Real:
    corners = surface.corners
    middle = unit(x[corners].mean(axis=0))
    sound = np.setdiff1d(np.arange(surface.m), inverted)
    if not len(sound):
        return x
    base = int(sound[np.argmin(middle[sound] @ middle[fold])])
    turn = turn_to_pole(middle[base])
    z = to_plane(x @ turn.T)
    reach = float(np.abs(z[corners[:, base]]).max())
    disk = surface.without_face(base)
    z = z / reach
    flat = repaired(disk, z, flipped_faces(z, disk.corners), disk.loops[0], progress)
    return from_plane(flat * reach) @ turn
