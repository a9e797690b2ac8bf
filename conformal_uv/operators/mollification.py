"""Intrinsic mollification: edge lengths of thin triangles made safe to compute with.

N. Sharp, K. Crane, "A Laplacian for nonmanifold triangle meshes", SGP 2020, section 4.5: every length grows by the
one smallest amount with which each triangle meets the triangle inequality with some room.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import DegenerateFaceError

__all__ = ["mollified"]

ROOM = 1e-12  # of a triangle's longest edge, or of the mean edge where that is longer


def mollified(lengths: NDArray[np.float64]) -> NDArray[np.float64]:
    """Lengths (3, m) of half-edges such that ``l_i + l_j - l_k >= ROOM * longest edge`` in every triangle.

    Lengths that do so already come back unchanged. A triangle without area gets an angle of about sqrt(ROOM).

    Raises
    ------
    DegenerateFaceError
        All lengths are 0.
    """
    if not lengths.max(initial=0.0) > 0.0:
        raise DegenerateFaceError("All vertices lie in one point; there is no surface to map.")
    room = ROOM * np.maximum(lengths.max(axis=0), lengths.mean())
    lack = float((room + lengths - lengths[[1, 2, 0]] - lengths[[2, 0, 1]]).max(initial=0.0))
    return lengths + lack if lack > 0.0 else lengths
