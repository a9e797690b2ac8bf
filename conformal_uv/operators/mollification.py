"""Intrinsic mollification: edge lengths of thin triangles made safe to compute with.

N. Sharp, K. Crane, "A Laplacian for nonmanifold triangle meshes", SGP 2020, section 4.5: every length grows by the
one smallest amount with which each triangle meets the triangle inequality with some room.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import DegenerateFaceError
from ..mesh.blocks import by_blocks

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
    mean = float(lengths.mean()) if lengths.size else 0.0
    if not mean > 0.0:
        raise DegenerateFaceError("All vertices lie in one point; there is no surface to map.")
    lack = max(by_blocks(lambda part: _lack(lengths[:, part], mean), lengths.shape[1]))
    return lengths + lack if lack > 0.0 else lengths


def _lack(lengths: NDArray[np.float64], mean: float) -> float:
    """What the worst of the triangles lacks of the room it is to have; not positive where all have it."""
    a, b, c = lengths
    longest = np.maximum(np.maximum(a, b), c)
    spare = a + b + c - 2.0 * longest  # the two shorter edges less the longest
    return float((ROOM * np.maximum(longest, mean) - spare).max())
