"""`mesh.distinguished` for a surface spread over ranks."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.distinguished import DIGITS, FARTHEST, ROUNDS, mixed
from .part import Part

__all__ = ["distinguished_vertex"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]
Colors = NDArray[np.uint64]


def distinguished_vertex(part: Part, candidates: Ints) -> int:
    """The one of vertices that are alike but for rounding that a copy of the mesh would give, too."""
    if len(candidates) == 1:
        return int(candidates[0])
    ranks, counted = part.ranks, part.counted
    a, b, c = (part.V[corner[counted]] for corner in part.corners)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    area = area / float(ranks.total(np.array([area.sum()]))[0])
    middles = (a + b + c) / 3.0
    middle = ranks.total(area @ middles)
    moved = middles - middle
    radius = float(np.sqrt(ranks.total(np.array([area @ (moved**2).sum(axis=1)]))[0])) or 1.0
    distance = np.linalg.norm(part.V - middle, axis=1) / radius
    color = np.round((FARTHEST - np.minimum(distance, FARTHEST)) * DIGITS).astype(np.uint64)
    left = _most(part, candidates, color)
    for _ in range(ROUNDS):
        if len(left) == 1:
            return int(left[0])
        color = part.with_ghosts(_refined(part, color))
        left = _most(part, left, color)
    moved /= radius
    size = (moved**2).sum(axis=1)
    one, other = ranks.total(np.stack(((area * size) @ moved, (area * size**2) @ moved)))
    side = np.round((_at(part, left, part.V) - middle) @ np.cross(one, other) / radius * DIGITS)
    return int(left[np.argmax(side)])


def _at(part: Part, vertices: Ints, values: NDArray[np.generic]) -> NDArray[np.generic]:
    """Values of some vertices, ascending, on all ranks."""
    own = vertices[part.vertices.owned(vertices)] - part.vertices.first
    return part.ranks.joined(values[own])


def _most(part: Part, vertices: Ints, color: Colors) -> Ints:
    values = _at(part, vertices, color)
    return vertices[values == values.max()]


def _refined(part: Part, color: Colors) -> Colors:
    """The own vertices' colours mixed with those around them."""
    with np.errstate(over="ignore"):
        before = mixed(color)
        face = mixed(before[part.corners[0]] + before[part.corners[1]] + before[part.corners[2]])
        total = before.copy()
        for corner in part.corners:
            np.add.at(total, corner, face)
        return mixed(total)[: part.own]
