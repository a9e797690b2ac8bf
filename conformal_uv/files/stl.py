"""STL, text or binary, through trimesh."""

from __future__ import annotations

import io
import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from conformal_uv.errors import FileFormatError
from conformal_uv.files.checks import DAMAGED, checked_mesh, foreign_parser, missing_library
from conformal_uv.files.mesh_file import MeshFile
from conformal_uv.files.weld import welded

__all__ = ["read_stl"]


def read_stl(path: Path, data: bytes) -> MeshFile:
    """Read an STL file; its loose triangles are joined where corners have exactly the same position."""
    soup = _triangles(path, data.removeprefix(b"\xef\xbb\xbf"))
    V, corners = welded(soup)
    return MeshFile(path, checked_mesh(path, V, corners, np.full(len(soup) // 3, 3, np.int64)))


def _triangles(path: Path, data: bytes) -> NDArray[np.float64]:
    """The corners of the triangles one after the other, (3m, 3)."""
    try:
        from trimesh.exchange.stl import load_stl
    except ImportError as error:
        raise missing_library("trimesh", ".stl") from error
    with foreign_parser(path, "STL", "trimesh"), warnings.catch_warnings():
        warnings.simplefilter("error")  # trimesh reads numbers up to the first that is none, and only warns
        loaded = load_stl(io.BytesIO(data))
        solids: list[dict[str, Any]] = [loaded] if "faces" in loaded else list(loaded["geometry"].values())
        parts = [np.asarray(s["vertices"], np.float64)[np.asarray(s["faces"])].reshape(-1, 3) for s in solids]
        soup = np.concatenate([np.empty((0, 3)), *parts])
    # trimesh leaves out a text solid without its end and joins facets whatever their number of corners
    facets = len(re.findall(rb"\bendfacet\b", data, re.IGNORECASE))
    if not _is_binary(data) and (len(soup) != 3 * facets or not facets):
        raise FileFormatError(f"{path}: {facets} facets, {len(soup)} corners in whole solids: {DAMAGED}")
    return soup


def _is_binary(data: bytes) -> bool:
    return len(data) >= 84 and len(data) == 84 + 50 * int.from_bytes(data[80:84], "little")
