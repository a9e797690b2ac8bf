"""Folds of a map to the sphere mended in the plane, in central projections from the middle of the ball.

A central projection takes great circles to straight lines, so that what unfolds in the plane is unfolded on the
sphere. Each fold is mended in the chart around it, together with all others that this chart shows well.
"""

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

CHARTS = 20  # folds to project around
HORIZON = 0.1  # height of what a chart shows; a pole's is 1


def unfolded(surface: Surface, x: Real, repair: Repair, progress: Progress) -> Real:
    """Positions (n, 3) with fewer or no inverted faces; x itself where nothing was inverted or nothing helped.

    Where patches do not mend all and `repair` is `always`, the surface without one face is embedded in the plane with
    that face as its outline, by its positive mean value weights (Floater 1997), and the patches go on from there.
    """
    best = _mended(surface, x, progress)
    folds = inverted_faces(best, surface.corners)
    if len(folds) and repair is Repair.ALWAYS:
        tried = _mended(surface, _embedded(surface, best, folds), progress)
        if len(inverted_faces(tried, surface.corners)) < len(folds):
            best = tried
    return best


def _mended(surface: Surface, x: Real, progress: Progress) -> Real:
    """Patches moved in charts around the folds: first a few charts for all, then one for each that is left."""
    corners = surface.corners
    folds = inverted_faces(x, corners)
    for shared in (True, False):
        seen = np.zeros(surface.m, dtype=bool)
        for _ in range(CHARTS):
            left = folds[~seen[folds]]
            if not len(left):
                break
            seen[left[0]] = True
            pole = x[corners[:, left[0]]].sum(axis=0)
            size = float(np.linalg.norm(pole))
            if size > HORIZON:
                x, shown = _in_chart(surface, x, pole / size, progress)
                seen |= shown & shared
                folds = inverted_faces(x, corners)
    return x


def _in_chart(surface: Surface, x: Real, pole: Real, progress: Progress) -> tuple[Real, NDArray[np.bool_]]:
    """Positions after patches were moved in the central projection around the pole, and the faces that it shows."""
    corners = surface.corners
    turn = turn_to_pole(pole)
    turned = x @ turn.T
    height = turned[:, 2]
    shown = height[corners].min(axis=0) > HORIZON
    movable = height > HORIZON
    movable[corners[:, ~shown]] = False
    scale = np.where(height > HORIZON, height, np.inf)
    z = (turned[:, 0] + 1j * turned[:, 1]) / scale

    def back(moved: NDArray[np.complex128]) -> Real:
        out = x.copy()
        there = moved != z
        flat = moved[there]
        out[there] = unit(np.column_stack((flat.real, flat.imag, np.ones(len(flat)))) @ turn)
        return out

    def folds_of(moved: NDArray[np.complex128]) -> NDArray[np.int64]:
        folds = inverted_faces(back(moved), corners)
        return folds[shown[folds]]

    return back(repaired(corners, z, movable, folds_of, progress)), shown


def _embedded(surface: Surface, x: Real, folds: NDArray[np.int64]) -> Real:
    """The embedding in the plane whose outline is the sound face of the largest image, projected to the sphere."""
    corners = surface.corners
    a, b, c = (x[corner] for corner in corners)
    size = np.einsum("ij,ij->i", a, np.cross(b, c))
    size[folds] = -np.inf
    held = corners[:, int(np.argmax(size))].astype(np.int64)
    turn = turn_to_pole(unit(x[held].mean(axis=0)[None])[0])
    z = np.zeros(surface.n, dtype=np.complex128)
    z[held] = to_plane((x @ turn.T)[held])
    free = np.setdiff1d(np.arange(surface.n), held)
    return unit(from_plane(NeighbourMeans(surface_mean_value_matrix(surface), free).placed(z)) @ turn)
