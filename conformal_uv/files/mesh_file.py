"""A mesh as a file gave it."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..mesh.polygons import PolygonMesh

__all__ = ["MeshFile"]


@dataclass(frozen=True, eq=False)
class MeshFile:
    """A mesh, the texture coordinates it came with, and what else its file held.

    Attributes
    ----------
    path : Path
        The file it was read from.
    mesh : PolygonMesh
        Vertices and polygons, in the file's order.
    corner_uv : (k, 2) float64 or None
        The file's own texture coordinates, a row for each polygon corner; NaN for a corner that has none,
        None where the file has none at all.
    origin : object
        The rest of the file, for a writer of the same format to keep; None where nothing is kept. It is used
        only as long as ``mesh`` is the one it was read with.
    original_vertex : (n,) int64 or None
        Where vertices were split at seams, the vertex that each one was.
    """

    path: Path
    mesh: PolygonMesh
    corner_uv: NDArray[np.float64] | None = None
    origin: object = field(default=None, repr=False)
    original_vertex: NDArray[np.int64] | None = field(default=None, repr=False)
