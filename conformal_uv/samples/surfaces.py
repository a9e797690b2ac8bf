"""Disks in space: a flat one, a spherical cap, a mask, a terrain."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .planar import irregular_disk

__all__ = ["flat_disk", "mask", "spherical_cap", "terrain"]

Mesh = tuple[NDArray[np.float64], NDArray[np.int32]]


def flat_disk(n: int = 2000, seed: int = 0) -> Mesh:
    """The unit disk in the plane z = 0, irregularly triangulated: V (n, 3), F (m, 3)."""
    xy, F = irregular_disk(n, seed)
    return np.column_stack((xy, np.zeros(n))), F


def spherical_cap(n: int = 2000, angle: float = 60.0, seed: int = 0) -> Mesh:
    """The part of the unit sphere within `angle` degrees of the north pole: V (n, 3), F (m, 3).

    Vertices are spread so that triangles have nearly equal area.
    """
    xy, F = irregular_disk(n, seed)
    radius = np.hypot(xy[:, 0], xy[:, 1])
    polar = 2.0 * np.arcsin(np.minimum(radius, 1.0) * np.sin(np.radians(angle) / 2.0))
    ring = np.divide(np.sin(polar), radius, out=np.ones(n), where=radius > 0)
    return np.column_stack((xy * ring[:, None], np.cos(polar))), F


def mask(n: int = 20000, seed: int = 0) -> Mesh:
    """A face-like relief about 0.2 units high, like a scanned mask: V (n, 3), F (m, 3)."""
    xy, F = irregular_disk(n, seed)
    x, y = 0.075 * xy[:, 0], 0.105 * xy[:, 1]

    def bump(cx: float, cy: float, sx: float, sy: float, height: float) -> NDArray[np.float64]:
        return height * np.exp(-(((x - cx) / sx) ** 2) - ((y - cy) / sy) ** 2)

    head = 0.075 * np.sqrt(np.maximum(1.25 - (x / 0.075) ** 2 - (y / 0.105) ** 2, 0.0))
    z = head + bump(0.0, -0.005, 0.010, 0.028, 0.012) + bump(0.0, -0.022, 0.013, 0.011, 0.018)
    z += bump(0.0, 0.055, 0.045, 0.020, 0.005) + bump(0.0, -0.080, 0.020, 0.014, 0.010)
    for side in (-1.0, 1.0):
        z += bump(side * 0.027, 0.020, 0.015, 0.010, -0.010) + bump(side * 0.027, 0.020, 0.008, 0.006, 0.005)
        z += bump(side * 0.027, 0.035, 0.020, 0.006, 0.004) + bump(side * 0.035, -0.020, 0.018, 0.018, 0.005)
        z += bump(side * 0.012, -0.027, 0.006, 0.006, 0.006)
    z += bump(0.0, -0.047, 0.020, 0.005, 0.006) + bump(0.0, -0.057, 0.017, 0.005, 0.005)
    z += bump(0.0, -0.052, 0.022, 0.0025, -0.003)
    return np.column_stack((x, y, z)), F


def terrain(n: int = 10000, seed: int = 0) -> Mesh:
    """Bumpy ground on an irregular grid of about n vertices, made fast for any size: V, F.

    A square grid of ceil(sqrt(n)) squared vertices, jittered, every quadrangle cut along the diagonal that
    Delaunay's criterion prefers in plan.
    """
    side = int(np.ceil(np.sqrt(n)))
    rng = np.random.default_rng(seed)
    grid = np.linspace(0.0, 1.0, side)
    x, y = np.tile(grid, side), np.repeat(grid, side)
    number = np.arange(side * side, dtype=np.int32).reshape(side, side)
    inner = np.zeros((side, side))
    inner[1:-1, 1:-1] = 0.3 / (side - 1)
    x += inner.reshape(-1) * rng.uniform(-1.0, 1.0, side * side)
    y += inner.reshape(-1) * rng.uniform(-1.0, 1.0, side * side)
    z = np.zeros(side * side)
    for octave in range(6):
        frequency, height = 2.0**octave * np.pi, 0.12 / 2.0**octave
        turn, shift = rng.uniform(0.0, 2.0 * np.pi, 2)
        z += height * np.sin(frequency * (x * np.cos(turn) + y * np.sin(turn)) + shift)
        z += height * np.cos(frequency * (y * np.cos(turn) - x * np.sin(turn)) + 2.0 * shift)
    a, b = number[:-1, :-1].reshape(-1), number[:-1, 1:].reshape(-1)
    c, d = number[1:, 1:].reshape(-1), number[1:, :-1].reshape(-1)
    # The diagonal a-c is right when the angles at b and d sum to at most 180 degrees.
    keep = (_opposite_angles(x, y, a, b, c) + _opposite_angles(x, y, a, d, c)) <= np.pi
    first = np.where(keep, np.stack((a, b, c)), np.stack((a, b, d)))
    second = np.where(keep, np.stack((a, c, d)), np.stack((b, c, d)))
    return np.column_stack((x, y, z)), np.concatenate((first, second), axis=1).T.copy()


def _opposite_angles(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    i: NDArray[np.int32],
    j: NDArray[np.int32],
    k: NDArray[np.int32],
) -> NDArray[np.float64]:
    """Angle at j of the triangles i, j, k."""
    ux, uy, vx, vy = x[i] - x[j], y[i] - y[j], x[k] - x[j], y[k] - y[j]
    return np.arctan2(np.abs(ux * vy - uy * vx), ux * vx + uy * vy)
