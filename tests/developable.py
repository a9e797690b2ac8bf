"""Surfaces that can be laid into the plane as they are: (V, F) bent, and the plane they were cut from, (n, 2)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

__all__ = ["DEVELOPABLE", "cone", "cross", "cylinder", "folded_strip", "sector_fan"]

Real = NDArray[np.float64]
Sheet = tuple[Real, NDArray[np.int64], Real]


def _cells(cells: list[tuple[int, int]], fine: int) -> tuple[Real, NDArray[np.int64]]:
    """Unit squares at these places, each cut into fine x fine quadrangles and those into triangles."""
    x, y = np.meshgrid(np.arange(fine), np.arange(fine))
    corner = np.concatenate([np.column_stack((fine * a + x.ravel(), fine * b + y.ravel())) for a, b in cells])
    quads = corner[:, None] + [[0, 0], [1, 0], [1, 1], [0, 1]]
    points, number = np.unique(quads.reshape(-1, 2), axis=0, return_inverse=True)
    a, b, c, d = number.reshape(-1, 4).T
    F = np.where((corner.sum(axis=1) % 2 == 0)[:, None], np.column_stack((a, b, c)), np.column_stack((a, b, d)))
    G = np.where((corner.sum(axis=1) % 2 == 0)[:, None], np.column_stack((a, c, d)), np.column_stack((b, c, d)))
    return points / fine, np.concatenate((F, G))


def cross(fine: int = 4) -> Sheet:
    """The six squares of a cube, cut open to a cross."""
    xy, F = _cells([(0, 0), (-1, 0), (1, 0), (0, -1), (0, 1), (0, 2)], fine)
    x, y = xy.T
    V = np.column_stack((np.clip(x, 0, 1), np.clip(y, 0, 1), np.maximum.reduce((-x, x - 1, -y, y - 1, 0 * x))))
    V[y > 2] = np.column_stack((x, 3 - y, 1 + 0 * y))[y > 2]
    return V, F, xy


def cylinder(around: int = 24, high: int = 6) -> Sheet:
    """A prism, cut open along a seam."""
    rings = [(k, j) for k in range(around) for j in range(high)]
    xy, F = _cells(rings, 1)
    t, side = 2 * np.pi / around * xy[:, 0], 2 * np.sin(np.pi / around)
    V = np.column_stack((np.cos(t), np.sin(t), 0.4 * xy[:, 1]))
    return V, F, xy * [side, 0.4]


def cone(around: int = 20, high: int = 5) -> Sheet:
    """A pyramid over a regular polygon, its tip cut off, cut open along an edge."""
    xy, F = _cells([(k, j) for k in range(around) for j in range(high)], 1)
    t, r = 2 * np.pi / around * xy[:, 0], 3.0 - 0.4 * xy[:, 1]
    V = np.column_stack((r * np.cos(t), r * np.sin(t), 2.0 * (3.0 - r)))
    slant = r * np.sqrt(5.0)  # distance from the tip, on edges
    turn = 2 * np.arcsin(np.sin(np.pi / around) / np.sqrt(5.0)) * xy[:, 0]
    return V, F, np.column_stack((slant * np.cos(turn), slant * np.sin(turn)))


def folded_strip(quads: int = 30) -> Sheet:
    """A strip of paper, pleated along lines across it."""
    xy, F = _cells([(k, j) for k in range(quads) for j in range(3)], 1)
    fold = np.abs((xy[:, 0] + 2) % 4 - 2)
    return np.column_stack((np.sqrt(0.75) * xy[:, 0], xy[:, 1], 0.5 * fold)), F, xy


def sector_fan(degrees: float, triangles: int = 40) -> Sheet:
    """A fan with so many degrees in the middle, which more than 360 make cover itself; pleated in space."""
    t = np.radians(degrees) / triangles * np.arange(triangles + 1)
    k = np.arange(1, triangles + 1)
    F = np.column_stack((np.zeros_like(k), k, k + 1))
    flat = np.concatenate(([[0.0, 0.0]], np.column_stack((np.cos(t), np.sin(t)))))
    step = np.radians(degrees) / triangles
    rise = 0.5 * np.sin(step)  # of every second spoke
    angle = np.arccos(np.cos(step) / np.cos(np.arcsin(rise)))
    turn, up = angle * np.arange(triangles + 1), np.arcsin(rise) * (np.arange(triangles + 1) % 2)
    spokes = np.column_stack((np.cos(up) * np.cos(turn), np.cos(up) * np.sin(turn), np.sin(up)))
    return np.concatenate(([[0.0, 0.0, 0.0]], spokes)), F, flat


DEVELOPABLE: dict[str, Callable[[], Sheet]] = {
    "cube's cross": cross,
    "cylinder with a seam": cylinder,
    "cone": cone,
    "folded strip": folded_strip,
    "fan of 150 degrees": lambda: sector_fan(150.0),
}
