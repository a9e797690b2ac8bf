"""Folds of a map with a free boundary, mended by the patches that mend those of the disk."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..disk.embedding import DEAR
from ..disk.repair import Repair, repair_cost, repaired
from ..mesh.surface import Surface
from ..operators.orientation_sign import flipped_faces
from ..options import Repair as Choice
from ..progress import Progress

__all__ = ["unfolded"]

Complex = NDArray[np.complex128]


def unfolded(
    surface: Surface, loop: NDArray[np.int64], z: Complex, choice: Choice, progress: Progress
) -> tuple[Complex, Repair | None]:
    """Positions with fewer folds and what that cost; z itself where there are none, or none that may be mended.

    The boundary stays. `auto` pays half a degree of mean angle error.
    """
    folds = flipped_faces(z, surface.corners)
    if not len(folds) or choice is Choice.NEVER:
        return z, None
    inside = np.ones(surface.n, dtype=bool)
    inside[loop] = False
    progress("repair", 0.0)
    mended = repaired(surface.corners, z, inside, lambda moved: flipped_faces(moved, surface.corners), progress)
    left = flipped_faces(mended, surface.corners)
    if len(left) >= len(folds):
        return z, None
    cost = repair_cost(surface, z, mended, folds, left)
    if choice is Choice.AUTO and cost.angle_mean_after > cost.angle_mean_before + DEAR:
        return z, None
    return mended, cost
