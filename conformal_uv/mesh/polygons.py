"""A mesh of polygons of any size, as files and modelling programs keep it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..concise import Concise

__all__ = ["PolygonMesh"]


@dataclass(frozen=True, eq=False, repr=False)
class PolygonMesh(Concise):
    """Vertices and polygons; face f has the corners ``starts[f] .. starts[f + 1] - 1``.

    Attributes
    ----------
    V : (n, 3) float64
        Vertex positions.
    corners : (k,) int64
        The vertex of every corner, face after face, in winding order.
    starts : (p + 1,) int64
        Where each face's corners begin; ``starts[-1] == k``.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> mesh = cuv.PolygonMesh(np.eye(4, 3), np.array([0, 1, 2, 3]), np.array([0, 4]))
    >>> mesh.sizes.tolist()
    [4]
    """

    V: NDArray[np.float64]
    corners: NDArray[np.int64]
    starts: NDArray[np.int64]

    @property
    def sizes(self) -> NDArray[np.int64]:
        """Number of corners of each face, (p,)."""
        return np.diff(self.starts)
