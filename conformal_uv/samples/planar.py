"""Irregular triangulations of the unit disk."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay

__all__ = ["irregular_disk"]


def irregular_disk(n: int, seed: int = 0) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """A Delaunay triangulation of jittered points in the unit disk, its boundary on the unit circle.

    Parameters
    ----------
    n : int
        Number of vertices, at least 16.
    seed : int
        Of the jitter.

    Returns
    -------
    xy : (n, 2) float64
    F : (m, 3) int32
        Wound anticlockwise.
    """
    rng = np.random.default_rng(seed)
    spacing = np.sqrt(np.pi / n)
    ring = max(6, round(2.0 * np.pi / spacing))
    inner = n - ring
    # Sunflower points (Vogel 1979), spread over what the boundary ring leaves free.
    k = np.arange(inner) + 0.5
    radius = (1.0 - 0.75 * spacing) * np.sqrt(k / inner)
    angle = k * np.pi * (3.0 - np.sqrt(5.0))
    points = np.column_stack((radius * np.cos(angle), radius * np.sin(angle)))
    points += rng.uniform(-0.2, 0.2, points.shape) * spacing * (radius < 1.0 - 1.5 * spacing)[:, None]
    turn = 2.0 * np.pi / ring * np.arange(ring)
    xy = np.concatenate((np.column_stack((np.cos(turn), np.sin(turn))), points))
    F = Delaunay(xy).simplices.astype(np.int32)
    a, b, c = xy[F[:, 0]], xy[F[:, 1]], xy[F[:, 2]]
    clockwise = np.linalg.det(np.stack((b - a, c - a), axis=1)) < 0
    F[clockwise] = F[clockwise][:, ::-1]
    return xy, F
