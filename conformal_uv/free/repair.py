"""Folds of a map with a free boundary, mended where they are."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..disk.repair import Repair, repair_cost, repaired
from ..disk.untangling import untangled
from ..mesh.surface import Surface
from ..operators.nearby_maps import NearbyMaps
from ..operators.orientation_sign import flipped_faces
from ..options import Repair as Choice
from ..progress import Progress

__all__ = ["unfolded"]

Complex = NDArray[np.complex128]


def unfolded(
    surface: Surface,
    inside: NDArray[np.bool_],
    z: Complex,
    held: bool,
    choice: Choice,
    backend: str,
    progress: Progress,
) -> tuple[Complex, Repair | None]:
    """Positions with fewer folds and what that cost; z itself where there are none, or none that may be mended.

    Patches inside at means of their neighbours first; where that is not enough, vertices near folds, those of the
    boundary too if it is not held, where the energy of angles is least. `auto` pays half a degree of mean angle error.
    """
    folds = flipped_faces(z, surface.corners)
    if not len(folds) or choice is Choice.NEVER:
        return z, None
    maps = NearbyMaps(surface, z, folds)
    best, found = z, None
    for mended in _ways(surface, inside, z, held, backend, progress):
        left = flipped_faces(mended, surface.corners)
        cost = repair_cost(maps, z, mended, folds, left)
        dear = cost.angle_mean_after > cost.angle_mean_before + choice.pays
        if not dear and len(left) < (len(folds) if found is None else found.flipped_after):
            best, found = mended, cost
        if found is not None and not found.flipped_after:
            break
    return best, found


def _ways(
    surface: Surface, inside: NDArray[np.bool_], z: Complex, held: bool, backend: str, progress: Progress
) -> Iterator[Complex]:
    def folds_of(moved: Complex) -> NDArray[np.int64]:
        return flipped_faces(moved, surface.corners)

    progress("repair", 0.0)
    mended = repaired(surface.corners, z, inside, folds_of, progress)
    yield mended
    movable = inside if held else np.ones_like(inside)
    for start in (z, mended):
        yield untangled(surface, start, movable, folds_of, backend, progress)
