"""One of several vertices that are alike, chosen by the surface and not by how it was written down.

Where a choice among vertices is a tie but for rounding, the scale, the position or the numbering of the mesh would
decide it, and with it the whole map. The nearest to the middle of the surface is taken; then the same of the
neighbours, and their neighbours, decides, and at last on which side of the surface's own directions a vertex lies,
which tells mirror images apart. Vertices that are still alike are so by a symmetry of the surface.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["distinguished", "mixed"]

DIGITS = 1e7  # parts of the surface's radius that distances are told apart to
FARTHEST = 1e3  # radii
ROUNDS = 24  # rings of neighbours that are looked at
MIX = np.uint64(0x9E3779B97F4A7C15)  # 2^64 over the golden ratio


def distinguished(V: NDArray[np.float64], corners: NDArray[np.int32], candidates: NDArray[np.int64]) -> int:
    """The candidate that a turned, scaled, moved or renumbered copy of the mesh would give, too.

    Parameters
    ----------
    V : (n, 3) float64
    corners : (3, m) int32
    candidates : (k,) integers, k > 0
    """
    left = np.asarray(candidates)
    if len(left) == 1:
        return int(left[0])
    a, b, c = (V[corner] for corner in corners)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    area = area / area.sum() if area.sum() > 0.0 else np.full(len(area), 1.0 / len(area))
    middles = (a + b + c) / 3.0
    around = V - area @ middles
    radius = float(np.sqrt(area @ ((middles - area @ middles) ** 2).sum(axis=1))) or 1.0
    distance = np.linalg.norm(around, axis=1) / radius
    color = np.round((FARTHEST - np.minimum(distance, FARTHEST)) * DIGITS).astype(np.uint64)  # the nearest first
    left = _most(left, color[left])
    for _ in range(ROUNDS):
        if len(left) == 1:
            return int(left[0])
        color = _refined(color, corners)
        left = _most(left, color[left])
    moved = (middles - area @ middles) / radius
    size = (moved**2).sum(axis=1)
    one, other = (area * size) @ moved, (area * size**2) @ moved  # third and fifth moments: directions of its own
    side = np.round(around[left] @ np.cross(one, other) / radius * DIGITS)
    return int(left[np.argmax(side)])


def _most(vertices: NDArray[np.int64], values: NDArray[np.uint64]) -> NDArray[np.int64]:
    return vertices[values == values.max()]


def _refined(color: NDArray[np.uint64], corners: NDArray[np.int32]) -> NDArray[np.uint64]:
    """Each vertex's colour mixed with those of the faces around it; sums forget the order."""
    with np.errstate(over="ignore"):
        before = mixed(color)
        face = mixed(before[corners[0]] + before[corners[1]] + before[corners[2]])
        total = before.copy()
        for corner in corners:
            np.add.at(total, corner, face)
        return mixed(total)


def mixed(x: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """A bijection that scatters (Steele, Lea, Flood 2014)."""
    with np.errstate(over="ignore"):
        x = x + MIX
        x = (x ^ (x >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
        x = (x ^ (x >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
        return x ^ (x >> np.uint64(31))
