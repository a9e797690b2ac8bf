"""How a surface is seen first: along its mean normal, upright as its charts are."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..options import Upright

__all__ = ["first_view", "seen_triangles"]

Real = NDArray[np.float64]

LIES_FLAT = 0.05  # sine of the slope, as of charts
LIGHT = np.array([-0.35, 0.45, 0.82])
CLOSED = 1e-3  # a mean normal so short is none


def first_view(cross: Real, upright: Upright = Upright.NONE) -> Real:
    """What is to the right, up, and towards the beholder, as rows (3, 3); `cross` (m, 3) are area vectors."""
    mean = cross.sum(axis=0)
    if not np.linalg.norm(mean) >= CLOSED * np.linalg.norm(cross, axis=1).sum():
        mean = np.array([1.0, -1.0, 0.8])
    front = mean / np.linalg.norm(mean)
    right = np.cross(_up(front, upright), front)
    right /= np.linalg.norm(right)
    return np.stack((right, np.cross(front, right), front))


def seen_triangles(corners: Real, upright: Upright = Upright.NONE) -> tuple[Real, Real, Real]:
    """Triangles (m, 3, 3) seen along their mean normal: in the picture (m, 3, 2), depth (m,), colour (m, 4)."""
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    axes = first_view(cross, upright)
    turned = corners @ axes.T
    length = np.maximum(np.linalg.norm(cross, axis=1, keepdims=True), np.finfo(float).tiny)
    facing = (cross / length) @ axes.T @ (LIGHT / np.linalg.norm(LIGHT))
    light = 0.97 * (0.5 + 0.5 * facing) ** 1.5
    colour = np.column_stack((light, 0.97 * light, 0.92 * light, np.ones(len(corners))))
    return turned[:, :, :2], turned[:, :, 2].mean(axis=1), colour


def _up(front: Real, upright: Upright) -> Real:
    """What is up in the picture of a surface seen from `front`: as of its charts, else y, or z of what faces y."""
    y, z = np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0])
    if upright is Upright.NONE:
        return y if abs(front[1]) < 0.8 else z
    axis, beyond = (z, y) if upright is Upright.Z else (y, -z)
    return axis if np.linalg.norm(np.cross(front, axis)) > LIES_FLAT else beyond
