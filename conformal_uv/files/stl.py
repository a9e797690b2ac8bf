"""STL, text or binary."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import FileFormatError
from .checks import DAMAGED, checked_mesh
from .mesh_file import MeshFile
from .stl_text import text_corners
from .weld import welded

__all__ = ["read_stl"]

HEADER, COUNT = 80, 84  # bytes before the number of facets, and with it
FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
BYTE_ORDER_MARK = b"\xef\xbb\xbf"


def read_stl(path: Path, data: bytes) -> MeshFile:
    """Read an STL file; its loose triangles are joined where corners have exactly the same position."""
    soup = _binary(path, data)
    V, corners = welded(text_corners(path, data.removeprefix(BYTE_ORDER_MARK)) if soup is None else soup)
    sizes = np.broadcast_to(np.int64(3), len(corners) // 3)
    return MeshFile(path, checked_mesh(path, V.astype(np.float64, copy=False), corners, sizes))


def _binary(path: Path, data: bytes) -> NDArray[Any] | None:
    """The corners of a binary file one after the other, (3m, 3); None if it is text."""
    count = int.from_bytes(data[HEADER:COUNT], "little")
    if len(data) >= COUNT and len(data) == COUNT + FACET.itemsize * count:
        return np.ndarray(count, FACET, data, COUNT)["corners"].reshape(-1, 3).astype(np.float32, copy=False)
    if b"facet" in data[: 1 << 16].lower() or len(data) < COUNT:
        return None
    raise FileFormatError(
        f"{path}: neither a text STL file nor a binary one: {count} facets are declared, which take "
        f"{COUNT + FACET.itemsize * count} bytes, and the file has {len(data)}; {DAMAGED}"
    )
