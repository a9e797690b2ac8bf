"""How a surface is seen first: along its mean normal, upright as its charts are."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..options import Upright

__all__ = ["first_view"]

Real = NDArray[np.float64]

LIES_FLAT = 0.05  # sine of the slope, as of charts
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


def _up(front: Real, upright: Upright) -> Real:
    """What is up in the picture of a surface seen from `front`: as of its charts, else y, or z of what faces y."""
    y, z = np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0])
    if upright is Upright.NONE:
        return y if abs(front[1]) < 0.8 else z
    axis, beyond = (z, y) if upright is Upright.Z else (y, -z)
    return axis if np.linalg.norm(np.cross(front, axis)) > LIES_FLAT else beyond
