"""Folds in a rectangle mended: vertices around them moved, then sides in order and weights that are positive.

Sides may run back where the Laplacian's weights along them are negative. With the sides in order and positive weights
the map is an embedding (Tutte 1963) but for faces that have all three vertices on one side: no map gives them area.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..disk.repair import Repair, repair_cost, repaired
from ..disk.untangling import untangled
from ..mesh.surface import Surface
from ..operators.mean_value import NeighbourMeans, surface_mean_value_matrix
from ..operators.nearby_maps import NearbyMaps
from ..operators.orientation_sign import flipped_faces
from ..options import Repair as Choice
from ..progress import Progress

__all__ = ["squashed_faces", "unfolded"]

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]
Ints = NDArray[np.int64]

SHARES = (1e-12, 1e-9, 1e-6, 1e-4, 1e-2, 1.0)  # of spacing by length, where sides do not advance


def squashed_faces(surface: Surface, sides: list[Ints]) -> Ints:
    """Faces with all three vertices on one side."""
    on = np.zeros(surface.n, dtype=np.uint8)
    for number, side in enumerate(sides):
        on[side] |= 1 << number
    a, b, c = on[surface.corners]
    return np.flatnonzero(a & b & c)


def unfolded(
    surface: Surface, z: Complex, sides: list[Ints], choice: Choice, backend: str, progress: Progress
) -> tuple[Complex, Repair | None]:
    """Positions with fewer folds and what that cost; z itself where there are none, or none that may be mended.

    The corners stay, and all of the boundary on its sides. `auto` pays half a degree of mean angle error.
    """
    squashed = squashed_faces(surface, sides)

    def folds_of(moved: Complex) -> Ints:
        return np.setdiff1d(flipped_faces(moved, surface.corners), squashed, assume_unique=True)

    folds = folds_of(z)
    if not len(folds) or choice is Choice.NEVER:
        return z, None
    inside = np.ones(surface.n, dtype=bool)
    inside[np.concatenate(sides)] = False
    maps = NearbyMaps(surface, z, folds)
    best, found = z, None
    fewest = len(folds)
    for tried in _ways(surface, z, sides, inside, progress):
        mended = repaired(surface.corners, tried, inside, folds_of, progress)
        if len(folds_of(mended)):
            mended = untangled(surface, tried, inside, folds_of, backend, progress)
        left = folds_of(mended)
        if len(left) >= fewest:
            continue
        cost = repair_cost(maps, z, mended, folds, left)
        if cost.angle_mean_after <= cost.angle_mean_before + choice.pays:
            best, found, fewest = mended, cost, len(left)
        if not fewest:
            break
    return best, found


def _ways(
    surface: Surface, z: Complex, sides: list[Ints], inside: NDArray[np.bool_], progress: Progress
) -> Iterator[Complex]:
    """Maps with fewer and fewer reasons to fold, each at a higher price."""
    progress("repair", 0.0)
    yield z
    means = None
    for number, share in enumerate(SHARES):
        progress("repair", (number + 1.0) / (len(SHARES) + 1.0))
        given = _in_order(surface, z, sides, share)
        yield given
        means = means or NeighbourMeans(surface_mean_value_matrix(surface), np.flatnonzero(inside))
        yield means.placed(given)


def _in_order(surface: Surface, z: Complex, sides: list[Ints], share: float) -> Complex:
    """z with the vertices of each side in order along it, with a share of spacing by length."""
    out = z.copy()
    for side in sides:
        start, way = z[side[0]], z[side[-1]] - z[side[0]]
        along = ((z[side] - start) / way).real
        forward, back = np.maximum.accumulate(along), np.minimum.accumulate(along[::-1])[::-1]
        steps = np.linalg.norm(np.diff(surface.V[side], axis=0), axis=1)
        even = np.concatenate(([0.0], np.cumsum(steps))) / steps.sum() if steps.any() else np.linspace(0, 1, len(side))
        place = (1.0 - share) * 0.5 * (forward + back) + share * even
        inner = side[1:-1]
        out[inner] = start + place[1:-1] * way  # one of the coordinates is the side's own, exactly
    return out
