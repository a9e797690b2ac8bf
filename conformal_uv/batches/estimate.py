"""How large a mesh is and what memory its map takes, by its file alone, which is not opened."""

from __future__ import annotations

import os
from pathlib import Path

from ..linear.memory import factorization_memory
from ..options import MapKind

__all__ = ["estimated_memory", "estimated_vertices"]

# Bytes of a file for each vertex and its two triangles, at the least: a mesh is rather taken for larger than it is.
# PLY and npz with single precision, the latter a little packed; OBJ and OFF with short numbers; STL has the corners of
# each triangle.
BYTES = {".obj": 50, ".ply": 38, ".off": 40, ".stl": 100, ".npz": 30, ".glb": 24, ".vtu": 20}
OTHERS = 20
PACKED = 4  # what gzip makes of text, about

# Growth of the process's peak beyond the factorizations', measured on terrains of 20,000 and 200,000 vertices: 500 and
# 390 bytes a vertex for a disk, 580 and 430 with a free boundary. The sphere keeps two factorizations, and takes beyond
# them 450 and 280 at 10,242 and 40,962 vertices. The process itself takes 93 MB.
PROCESS = 120 << 20
A_VERTEX = 700


def estimated_vertices(path: str) -> int:
    """Vertices of a file, rather too many than too few; 0 where there is no file."""
    try:
        size = os.path.getsize(path)
    except OSError:
        return 0
    suffixes = [suffix.lower() for suffix in Path(path).suffixes[-2:]]
    if suffixes[-1:] == [".gz"]:
        size, suffixes = PACKED * size, suffixes[:-1]
    return size // BYTES.get(suffixes[-1] if suffixes else "", OTHERS)


def estimated_memory(n: int, kind: MapKind) -> int:
    """Bytes that a process takes that maps a mesh of so many vertices, about, rather too many than too few."""
    factorizations = 2 if kind is MapKind.SPHERE else 1
    return PROCESS + A_VERTEX * n + factorizations * factorization_memory(n, "cholmod")
