"""Steps of boundary angles, one row of angles for each disk, that keep their order."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["gaps", "in_order"]

Real = NDArray[np.float64]

TINY = np.finfo(np.float64).tiny
LINEAR_TO = 0.2  # of the angle between two neighbours, to which a step closes it as it says; beyond, less and less


def gaps(theta: Real) -> Real:
    """Angle from each vertex to the next, around each row of (..., nb)."""
    return np.diff(theta, append=theta[..., :1] + 2.0 * np.pi)


def in_order(theta: Real, step: Real) -> Real:
    """theta + step (..., nb) where that keeps the order of a row, else a curve that begins so and never breaks it.

    A gap that the step would close to less than a part of itself closes exponentially: twice differentiable but for
    one point, and any step, however long, moves all other vertices as it says.
    """
    moved = theta + step
    before = gaps(theta)
    change = np.roll(step, -1, axis=-1) - step
    least = (LINEAR_TO - 1.0) * np.maximum(before, 0.0)
    rows = (change < least).any(axis=-1)
    if not rows.any():
        return moved
    before, change, least = before[rows], change[rows], least[rows]
    wide = np.maximum(before, TINY)
    beyond = np.clip(change - least, -700.0 * wide, 0.0) / (LINEAR_TO * wide)
    closing = np.where(before > TINY, LINEAR_TO * wide * np.exp(beyond), 0.0)
    kept = np.where(change < least, closing, np.maximum(before + change, 0.0))
    kept *= 2.0 * np.pi / kept.sum(axis=-1, keepdims=True)
    moved[rows, 1:] = moved[rows, :1] + np.cumsum(kept, axis=-1)[..., :-1]
    return moved
