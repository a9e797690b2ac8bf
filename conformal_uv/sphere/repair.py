"""Folds of a map to the sphere mended in the plane: in the chart of either hemisphere, around each fold."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..disk.repair import repaired
from ..mesh.surface import Surface
from ..operators.mean_value import NeighbourMeans, surface_mean_value_matrix
from ..operators.orientation_sign import inverted_faces
from ..options import Repair
from ..progress import Progress
from .centring import turn_to_pole, unit
from .stereographic import from_plane, to_plane

__all__ = ["unfolded"]

Real = NDArray[np.float64]

REACH = 0.5  # height up to which vertices may move in the chart of the southern hemisphere
TURNS = (np.ones(3), np.array([1.0, -1.0, -1.0]))  # the second exchanges the poles


def unfolded(surface: Surface, x: Real, repair: Repair, progress: Progress) -> Real:
    """Positions (n, 3) with fewer or no inverted faces; x itself where nothing was inverted or nothing helped.

    Where patches do not mend all and `repair` is `always`, the surface without one face is embedded in the plane with
    that face as its outline, by its positive mean value weights (Floater 1997).
    """
    start = inverted_faces(x, surface.corners)
    best, folds = x, start
    for turn in TURNS:
        if len(folds):
            tried = _mended(surface, best, turn, progress)
            left = inverted_faces(tried, surface.corners)
            if len(left) < len(folds):
                best, folds = tried, left
    if len(folds) and repair is Repair.ALWAYS:
        tried = _embedded(surface, best, folds)
        if len(inverted_faces(tried, surface.corners)) < len(folds):
            best = tried
    return best


def _mended(surface: Surface, x: Real, turn: Real, progress: Progress) -> Real:
    """Patches moved in the stereographic chart of one hemisphere."""
    turned = x * turn
    movable = turned[:, 2] < REACH
    z = to_plane(np.where(movable[:, None], turned, [0.0, 0.0, -1.0]))
    z[~movable] = to_plane(np.column_stack((turned[~movable, :2], np.minimum(turned[~movable, 2], 1.0 - 1e-15))))

    def back(moved: NDArray[np.complex128]) -> Real:
        out = x.copy()
        there = moved != z
        out[there] = unit(from_plane(moved[there]) * turn)
        return out

    def folds_of(moved: NDArray[np.complex128]) -> NDArray[np.int64]:
        folds = inverted_faces(back(moved), surface.corners)
        return folds[movable[surface.corners[:, folds]].any(axis=0)]

    return back(repaired(surface.corners, z, movable, folds_of, progress))


def _embedded(surface: Surface, x: Real, folds: NDArray[np.int64]) -> Real:
    """The embedding whose outline is the sound face of the largest image."""
    corners = surface.corners
    a, b, c = (x[corner] for corner in corners)
    size = np.einsum("ij,ij->i", a, np.cross(b, c))
    size[folds] = -np.inf
    base = int(np.argmax(size))
    turn = turn_to_pole(unit(x[corners[:, base]].mean(axis=0)[None])[0])
    outline = np.array([base])
    held = corners[:, outline].reshape(-1).astype(np.int64)
    z = np.zeros(surface.n, dtype=np.complex128)
    z[held] = to_plane((x @ turn.T)[held])
    free = np.setdiff1d(np.arange(surface.n), held)
    return unit(from_plane(NeighbourMeans(surface_mean_value_matrix(surface), free).placed(z)) @ turn)
