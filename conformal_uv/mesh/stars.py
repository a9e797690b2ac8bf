"""The faces around some of the vertices, and those among them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .blocks import by_blocks

__all__ = ["faces_among", "faces_at"]


def faces_at(corners: NDArray[np.int32], marked: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Faces (3, m) with a marked (n,) corner, (k,)."""

    def found(part: slice) -> NDArray[np.int64]:
        a, b, c = (marked.take(corner) for corner in corners[:, part])
        return part.start + np.flatnonzero(a | b | c)

    return np.concatenate(by_blocks(found, corners.shape[1]) or [np.empty(0, dtype=np.int64)])


def faces_among(corners: NDArray[np.int32], marked: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Faces (3, m) all of whose corners are marked (n,), (k,)."""

    def found(part: slice) -> NDArray[np.int64]:
        a, b, c = (marked.take(corner) for corner in corners[:, part])
        return part.start + np.flatnonzero(a & b & c)

    return np.concatenate(by_blocks(found, corners.shape[1]) or [np.empty(0, dtype=np.int64)])
