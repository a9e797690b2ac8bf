"""Seams: from a text file, or from where the mesh's own UVs are torn."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import FileFormatError, OptionError
from ..mesh.polygon_sides import following_corners
from .mesh_file import MeshFile

__all__ = ["read_seams"]


def read_seams(source: str | None, mesh_file: MeshFile) -> NDArray[np.int64] | None:
    """Vertex pairs (s, 2) from a file of lines ``i j`` (from 0, # begins a comment), or from "uv".

    Raises
    ------
    FileFormatError
        The file is not such a list.
    OptionError
        "uv" on a mesh without UVs.
    """
    if source is None:
        return None
    if source == "uv":
        return _torn_edges(mesh_file)
    path = Path(source)
    try:
        pairs = np.loadtxt(path, dtype=np.int64, ndmin=2, comments="#")
    except (OSError, ValueError) as error:
        raise FileFormatError(f"{path}: not a list of seams ({error}); write two vertex numbers a line.") from error
    if pairs.size and pairs.shape[1] != 2:
        raise FileFormatError(f"{path}: {pairs.shape[1]} numbers a line; write two vertex numbers a line.")
    return pairs.reshape(-1, 2)


def _torn_edges(mesh_file: MeshFile) -> NDArray[np.int64]:
    """Edges on whose two sides a vertex has different UVs."""
    mesh, uv = mesh_file.mesh, mesh_file.corner_uv
    if uv is None:
        raise OptionError(f"--seams uv: {mesh_file.path} has no UVs to read seams from.")
    corner = np.arange(len(mesh.corners))
    following = following_corners(mesh)
    tail, head = mesh.corners, mesh.corners[following]
    turned = tail > head
    low, high = np.where(turned, head, tail), np.where(turned, tail, head)
    at_low = uv[np.where(turned, following, corner)]
    at_high = uv[np.where(turned, corner, following)]
    order = np.lexsort((high, low))
    same = (np.diff(low[order]) == 0) & (np.diff(high[order]) == 0)
    first, second = order[:-1][same], order[1:][same]
    torn = (at_low[first] != at_low[second]).any(axis=1) | (at_high[first] != at_high[second]).any(axis=1)
    return np.column_stack((low[first[torn]], high[first[torn]]))
