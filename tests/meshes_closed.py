"""Closed surfaces for tests."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull


def icosphere(level: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """An icosahedron subdivided `level` times, its vertices on the unit sphere: 10 * 4^level + 2 of them."""
    golden = (1 + np.sqrt(5)) / 2
    V = np.array([[s, t * golden, 0.0] for s in (-1, 1) for t in (-1, 1)])
    V = np.concatenate((V, np.roll(V, 1, axis=1), np.roll(V, 2, axis=1))) / np.hypot(1, golden)
    F = ConvexHull(V).simplices.astype(np.int64)
    inward = np.linalg.det(V[F]) < 0
    F[inward] = F[inward][:, ::-1]
    for _ in range(level):
        sides = np.sort(np.concatenate((F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]])), axis=1)
        ends, middle = np.unique(sides, axis=0, return_inverse=True)
        ab, bc, ca = middle.reshape(3, -1) + len(V)
        a, b, c = F.T
        V = np.concatenate((V, V[ends].sum(axis=1)))
        V /= np.linalg.norm(V, axis=1, keepdims=True)
        F = np.concatenate([np.column_stack(f) for f in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return V, F
