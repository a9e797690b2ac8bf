"""OFF (Object File Format), text.

A reader of our own: trimesh cuts an OFF file's polygons into triangles, and the polygons are needed.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import FileFormatError
from .checks import DAMAGED, checked_mesh
from .mesh_file import MeshFile
from .spans import spans
from .text_lines import TextLines, text_blocks
from .text_numbers import in_32_bits, whole_numbers

__all__ = ["read_off"]

Ints = NDArray[np.int64]

WHOLE = re.compile(rb"-?\d{1,18}")
TOO_FEW = "numbers of vertices and faces that the file has no lines for"
HEADERS = {prefix + b"OFF" for prefix in (b"", b"C", b"N", b"CN", b"ST", b"STC", b"STN", b"STCN", b"NC")}


def read_off(path: Path, data: bytes) -> MeshFile:
    """Read an OFF file: vertices and polygons. Colours, normals and texture coordinates are passed over."""
    header: list[bytes] = []
    declared: tuple[TextLines, int] | None = None
    n = m = seen = first_face = 0
    V: list[NDArray[np.float64]] = []
    corners: list[NDArray[np.int32]] = []
    sizes: list[NDArray[np.int32]] = []
    for lines in text_blocks(path, data):
        left = np.arange(len(lines.counts))
        if not header and len(left):
            header = _header(path, lines)
            left = left[len(header) == 1 :]  # the counts stand on the header's own line or on the next
        if header and declared is None and len(left):
            declared = lines, int(left[0])
            n, m = _counts(lines, int(left[0]), len(header) > 1, len(data))
            first_face = seen + int(left[0]) + 1 + n
            left = left[1:]
        points, faces, left = left[:n], left[n : n + m], left[n + m :]
        V.append(lines.floats(points, 0, 3, 3))
        some = _polygons(lines, faces)
        corners.append(in_32_bits(some[0]))
        sizes.append(in_32_bits(some[1]))
        n, m = n - len(points), m - len(faces)
        seen += len(lines.counts)
    if declared is None:
        _header(path, lines)
        raise FileFormatError(f"{path}: no line with the numbers of vertices and faces; {DAMAGED}")
    if n or m:
        raise declared[0].error(declared[1], TOO_FEW)
    mesh = checked_mesh(
        path,
        np.concatenate(V),
        np.concatenate(corners, dtype=np.int64),
        np.concatenate(sizes, dtype=np.int64),
        lambda face: _place(path, data, first_face + face),
    )
    return MeshFile(path, mesh)


def _header(path: Path, lines: TextLines) -> list[bytes]:
    header = lines.words(np.arange(len(lines.counts))[:1])
    if not header or header[0] not in HEADERS:
        raise FileFormatError(
            f"{path}: not a text OFF file of 3-D points: it must begin with OFF "
            "(or COFF, NOFF, STOFF ...); export it again"
        )
    return header


def _counts(lines: TextLines, line: int, behind_header: bool, size: int) -> tuple[int, int]:
    """The numbers of vertices and faces."""
    counts = lines.floats(np.array([line]), int(behind_header), 2, 2)[0]
    if not (counts >= 0).all() or (counts % 1).any() or counts.sum() > size / 2:
        raise lines.error(line, TOO_FEW)
    n, m = counts.astype(np.int64).tolist()
    return n, m


def _place(path: Path, data: bytes, row: int) -> str:
    """Where the line stands that has so many lines with words above it."""
    for lines in text_blocks(path, data):
        if row < len(lines.counts):
            return f"line {lines.number(row)}"
        row -= len(lines.counts)
    raise IndexError(row)


def _polygons(lines: TextLines, chosen: Ints) -> tuple[Ints, Ints]:
    """Corners and sizes: each line is a count, as many indices, and perhaps a colour."""
    counts = lines.counts[chosen]
    first = np.cumsum(counts) - counts
    text = lines.behind(chosen, 0)[0].tobytes()
    values = whole_numbers(text, int(counts.sum()))
    words = text.split() if values is None else []
    sizes = _integers(lines, chosen, words, first, np.ones(len(chosen), np.int64)) if values is None else values[first]
    wrong = np.flatnonzero((sizes < 0) | (sizes >= counts))
    if len(wrong):
        raise lines.error(int(chosen[wrong[0]]), "a face is its number of corners and then the corners")
    if values is None:
        return _integers(lines, chosen, words, first + 1, sizes), sizes
    return values[spans(first + 1, sizes)], sizes


def _integers(lines: TextLines, chosen: Ints, words: list[bytes], first: Ints, sizes: Ints) -> Ints:
    """The ``sizes`` whole numbers from each line's first on, run together."""
    wanted = np.array(words, dtype=object)[spans(first, sizes)].tolist()
    try:
        return np.array(list(map(int, wanted)), dtype=np.int64)
    except (ValueError, OverflowError):
        bad = next((i for i, word in enumerate(wanted) if not WHOLE.fullmatch(word)), 0)
        line = int(chosen[np.searchsorted(np.cumsum(sizes), bad, side="right")])
        raise lines.error(line, "a word that is not a whole number") from None
