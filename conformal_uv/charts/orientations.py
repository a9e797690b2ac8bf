"""Ways in which charts may be turned to be packed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from ..options import PackRotation
from .outlines import Outlines

__all__ = ["angles", "hull"]

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]

QUARTER = 0.5 * np.pi
FEW = 64  # charts, up to which each is tried in MANY_WAYS
MANY_WAYS, SOME_WAYS = 16, 8
MOST_ASKEW = 150  # charts, up to which they are tried in more ways than along the axes: of more it gains nothing
MOST_SIDES = 256  # of a hull, that are tried
STEPS = 90  # in a quarter turn, that are tried besides


def angles(outlines: Outlines, rotation: PackRotation) -> Real:
    """Radians by which each chart is turned, (ways, k).

    The first way is that of charts that are not tried in others; the first four are those along the axes.
    """
    count = len(outlines)
    quarters = QUARTER * np.arange(4)[:, None]
    if rotation is PackRotation.NONE:
        return np.zeros((1, count))
    if rotation is PackRotation.QUARTERS:
        return quarters + np.zeros(count)
    flat, square = np.array([_turned_flat(hull(z)) for z in outlines.positions()]).T
    if rotation is PackRotation.AXES or count > MOST_ASKEW:
        return quarters + flat
    ways = MANY_WAYS if count <= FEW else SOME_WAYS
    turns = 4.0 * QUARTER * np.arange(ways) / ways
    askew = turns[np.arange(ways) % (ways // 4) > 0]
    return np.concatenate((quarters + flat, askew[:, None] + flat, quarters + square))


def hull(z: Complex) -> Complex:
    """Corners (h,) of the convex hull of points, anticlockwise; of points on a line their box."""
    try:
        return z[ConvexHull(z.view(np.float64).reshape(-1, 2)).vertices]
    except QhullError:
        low, high = z.real.min() + 1j * z.imag.min(), z.real.max() + 1j * z.imag.max()
        return np.array([low, high.real + 1j * low.imag, high, low.real + 1j * high.imag])


def _turned_flat(corners: Complex) -> tuple[float, float]:
    """Angles that bring a hull (h,) into the least box, lying, and into the least square."""
    sides = np.roll(corners, -1) - corners
    sides = sides[np.argsort(-np.abs(sides), kind="stable")[:MOST_SIDES]]
    tried = np.concatenate((-np.angle(sides[np.abs(sides) > 0.0]), QUARTER * np.arange(STEPS) / STEPS))
    z = corners[:, None] * np.exp(1j * tried)
    width, height = np.ptp(z.real, axis=0), np.ptp(z.imag, axis=0)
    flat, square = int((width * height).argmin()), int(np.maximum(width, height).argmin())
    return float(tried[flat]) + (QUARTER if height[flat] > width[flat] else 0.0), float(tried[square])
