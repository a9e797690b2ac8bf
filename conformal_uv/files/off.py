"""OFF (Object File Format), text.

A reader of our own: trimesh cuts an OFF file's polygons into triangles, and the polygons are needed.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from conformal_uv.errors import FileFormatError
from conformal_uv.files.checks import DAMAGED, checked_mesh
from conformal_uv.files.mesh_file import MeshFile
from conformal_uv.files.text_lines import TextLines, spans

__all__ = ["read_off"]

Ints = NDArray[np.int64]

WHOLE = re.compile(rb"-?\d{1,18}")
HEADERS = {prefix + b"OFF" for prefix in (b"", b"C", b"N", b"CN", b"ST", b"STC", b"STN", b"STCN", b"NC")}


def read_off(path: Path, data: bytes) -> MeshFile:
    """Read an OFF file: vertices and polygons. Colours, normals and texture coordinates are passed over."""
    lines = TextLines(path, data)
    inked = np.flatnonzero(lines.counts > 0)
    header = lines.words(inked[:1])
    if not header or header[0] not in HEADERS:
        raise FileFormatError(
            f"{path}: not a text OFF file of 3-D points: it must begin with OFF "
            "(or COFF, NOFF, STOFF ...); export it again"
        )
    # the counts stand on the header's own line or on the next
    row = 0 if len(header) > 1 else 1
    if len(inked) <= row:
        raise FileFormatError(f"{path}: no line with the numbers of vertices and faces; {DAMAGED}")
    counts = lines.floats(inked[row : row + 1], 1 - row, 2, 2)[0]
    if not (counts >= 0).all() or (counts % 1).any() or counts.sum() > len(inked) - row - 1:
        raise lines.error(int(inked[row]), "numbers of vertices and faces that the file has no lines for")
    n, m = counts.astype(np.int64).tolist()
    V = lines.floats(inked[row + 1 : row + 1 + n], 0, 3, 3)
    face_lines = inked[row + 1 + n : row + 1 + n + m]
    corners, sizes = _polygons(lines, face_lines)
    mesh = checked_mesh(path, V, corners, sizes, lambda face: f"line {lines.number(int(face_lines[face]))}")
    return MeshFile(path, mesh)


def _polygons(lines: TextLines, face_lines: Ints) -> tuple[Ints, Ints]:
    """Corners and sizes: each line is a count, as many indices, and perhaps a colour."""
    sizes = _integers(lines, face_lines, 0, np.ones(len(face_lines), np.int64))
    wrong = np.flatnonzero((sizes < 0) | (sizes >= lines.counts[face_lines]))
    if len(wrong):
        line = int(face_lines[wrong[0]])
        raise lines.error(line, "a face is its number of corners and then the corners")
    return _integers(lines, face_lines, 1, sizes), sizes


def _integers(lines: TextLines, chosen: Ints, skip: int, sizes: Ints) -> Ints:
    """The ``sizes`` whole numbers after each line's first ``skip`` words, run together."""
    counts = lines.counts[chosen]
    at = spans(np.cumsum(counts) - counts + skip, sizes)
    words = np.array(lines.words(chosen), dtype=object)[at].tolist()
    try:
        return np.array(list(map(int, words)), dtype=np.int64)
    except (ValueError, OverflowError):
        bad = next((i for i, word in enumerate(words) if not WHOLE.fullmatch(word)), 0)
        line = int(chosen[np.searchsorted(np.cumsum(sizes), bad, side="right")])
        raise lines.error(line, "a word that is not a whole number") from None
