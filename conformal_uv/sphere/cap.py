"""Boundary loops closed by virtual caps: a vertex in the middle of each, joined to all of the loop."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.surface import Surface

__all__ = ["capped"]


def capped(surface: Surface) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Vertices and faces of the surface with its loops closed; the caps' vertices and faces follow its own."""
    V, F = [surface.V * surface.unit], [surface.F.astype(np.int64)]
    for number, loop in enumerate(surface.loops):
        apex = np.full(len(loop), surface.n + number, dtype=np.int64)
        V.append(V[0][loop].mean(axis=0, keepdims=True))
        F.append(np.column_stack((np.roll(loop, -1), loop, apex)))
    return np.concatenate(V), np.concatenate(F)
