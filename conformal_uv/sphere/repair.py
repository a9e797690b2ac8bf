"""Folds of a map to the sphere mended in the plane, in central projections from the middle of the ball.

A central projection takes great circles to straight lines, so that what unfolds in the plane is unfolded on the
sphere. Each fold is mended in the chart around it, together with all others that this chart shows well.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from ..disk.repair import repaired
from ..errors import SolverError
from ..mesh.surface import Surface
from ..operators.mean_value import NeighbourMeans, surface_mean_value_matrix
from ..operators.orientation_sign import inverted_faces
from ..progress import Progress
from .centring import turn_to_pole, unit
from .stereographic import from_plane, to_plane

__all__ = ["embeddings", "mended"]

Real = NDArray[np.float64]

CHARTS = 20  # folds to project around
HORIZON = 0.1  # height of what a chart shows; a pole's is 1


def mended(surface: Surface, x: Real, progress: Progress) -> Real:
    """Positions (n, 3) with fewer or no inverted faces; x itself where nothing was inverted or nothing helped.

    Patches are moved in charts around the folds: first a few charts for all, then one for each that is left.
    """
    corners = surface.corners
    folds = inverted_faces(x, corners)
    for shared in (True, False):
        seen = np.zeros(surface.m, dtype=bool)
        for _ in range(CHARTS):
            left = folds[~seen[folds]]
            if not len(left):
                break
            a, b, c = x[corners[:, left]]
            widest = np.argmax(np.linalg.norm(b - a, axis=1) + np.linalg.norm(c - b, axis=1))  # however numbered
            seen[left[widest]] = True
            pole = (a + b + c)[widest]
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


def embeddings(surface: Surface, x: Real, folds: NDArray[np.int64]) -> Iterator[Real]:
    """The surface without one face embedded in the plane with that face as its outline, projected to the sphere.

    By its positive mean value weights (Floater 1997), then by uniform ones (Tutte 1963), which crowd the least. The
    outline is the sound face with the largest image.
    """
    corners = surface.corners
    a, b, c = (x[corner] for corner in corners)
    size = np.einsum("ij,ij->i", a, np.cross(b, c))
    size[folds] = -np.inf
    held = corners[:, int(np.argmax(size))].astype(np.int64)
    turn = turn_to_pole(unit(x[held].mean(axis=0)[None])[0])
    z = np.zeros(surface.n, dtype=np.complex128)
    z[held] = to_plane((x @ turn.T)[held])
    free = np.setdiff1d(np.arange(surface.n), held)
    for weights in (surface_mean_value_matrix(surface), _uniform_matrix(surface)):
        try:
            yield unit(from_plane(NeighbourMeans(weights, free).placed(z)) @ turn)
        except SolverError:
            continue


def _uniform_matrix(surface: Surface) -> csr_array:
    lo, hi = surface.edges.lo, surface.edges.hi
    ends = np.concatenate((lo, hi)), np.concatenate((hi, lo))
    return csr_array((np.ones(2 * len(lo)), ends), shape=(surface.n, surface.n))
