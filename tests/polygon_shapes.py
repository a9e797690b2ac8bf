"""Polygon meshes built by rule, for the tests of charts."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Polygons = tuple[NDArray[np.float64], NDArray[np.int64]]

CUBE_V = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
CUBE = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])


def sides_of(polygons) -> NDArray[np.int64]:
    """Every side of every polygon as a vertex pair."""
    return np.array([(q[i - 1], q[i]) for q in polygons for i in range(len(q))])


def block(solid: NDArray[np.bool_]) -> Polygons:
    """The surface of the unit cubes that are solid, as quads that face outwards."""
    solid = np.pad(np.asarray(solid, dtype=bool), 1)
    corners, quads = {}, []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for step in (1, -1):
            for cell in np.argwhere(solid & ~np.roll(solid, -step, axis)):
                at = cell.copy()
                at[axis] += step > 0
                ring = [(0, 0), (1, 0), (1, 1), (0, 1)][::step]
                quad = []
                for du, dv in ring:
                    point = at.copy()
                    point[u] += du
                    point[v] += dv
                    quad.append(corners.setdefault(tuple(point.tolist()), len(corners)))
                quads.append(quad)
    return np.array(list(corners), dtype=float), np.array(quads)


def rings(holes: int, size: int = 1) -> Polygons:
    """A slab with a row of through holes: a closed surface with as many handles."""
    solid = np.ones((3, 1 + 2 * holes, 1), dtype=bool)
    solid[1, 1::2] = False
    for axis in range(3):
        solid = np.repeat(solid, size, axis=axis)
    return block(solid)


def tube(around: int, along: int, length: float) -> Polygons:
    """An open cylinder of quads; vertices 0 .. around - 1 are its lower rim."""
    t = 2.0 * np.pi / around * np.arange(around)
    V = np.concatenate([np.column_stack((np.cos(t), np.sin(t), 0 * t + z)) for z in np.linspace(0, length, along + 1)])
    a = (np.arange(around) + around * np.arange(along)[:, None]).reshape(-1)
    b = (np.roll(np.arange(around), -1) + around * np.arange(along)[:, None]).reshape(-1)
    return V, np.column_stack((a, b, b + around, a + around))


def grid(columns: int, rows: int) -> Polygons:
    """Flat unit quads in the plane z = 0."""
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0))
    number = np.arange((rows + 1) * (columns + 1)).reshape(rows + 1, columns + 1)
    quads = [q.reshape(-1) for q in (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1])]
    return np.column_stack((x.reshape(-1), y.reshape(-1), 0.0 * x.reshape(-1))), np.column_stack(quads)


def side_by_side(count: int, columns: int = 3, rows: int = 2) -> Polygons:
    """Separate grids, one size larger than the other."""
    V, Q = grid(columns, rows)
    n = len(V)
    places = np.concatenate([V * (1.0 + 0.2 * k) + [20.0 * k, 0.0, 0.0] for k in range(count)])
    return places, np.concatenate([Q + n * k for k in range(count)])
