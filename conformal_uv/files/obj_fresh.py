"""A Wavefront OBJ file written from nothing: vertices, texture coordinates and faces."""

from __future__ import annotations

from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..mesh.polygons import PolygonMesh
from .corner_uv import mapped_faces, shared_uv
from .digits import WORD, compacted, digit_words
from .float_texts import float_rows

__all__ = ["write_fresh_obj"]

ROWS = 1 << 16  # lines written together


def write_fresh_obj(stream: BinaryIO, mesh: PolygonMesh, corner_uv: NDArray[np.float64]) -> None:
    """Write the mesh; a face with a corner that is NaN has no texture indices."""
    mapped = np.repeat(mapped_faces(mesh, corner_uv), mesh.sizes)
    texture = np.full(len(mesh.corners), -1, np.int64)
    texture[mapped], example = shared_uv(mesh.corners[mapped], corner_uv[mapped])
    for begin in range(0, len(mesh.V), ROWS):
        stream.write(float_rows(mesh.V[begin : begin + ROWS], b"v", b"\n")[0])
    uv = corner_uv[mapped][example]
    for begin in range(0, len(uv), ROWS):
        stream.write(float_rows(uv[begin : begin + ROWS], b"vt", b"\n")[0])
    for begin in range(0, len(mesh.starts) - 1, ROWS):
        stream.write(_face_lines(mesh, texture, begin, min(begin + ROWS, len(mesh.starts) - 1)))


def _face_lines(mesh: PolygonMesh, texture: NDArray[np.int64], begin: int, end: int) -> bytes:
    """The lines of some faces: each corner's words, with ``f`` before a face's first and a newline behind its last."""
    first, last = int(mesh.starts[begin]), int(mesh.starts[end])
    starts = mesh.starts[begin : end + 1] - first
    vertex = digit_words(mesh.corners[first:last] + 1)[0]
    mark = np.full(last - first, b" "[0], WORD)
    mark[starts[:-1]] = np.frombuffer(b"f \0\0", WORD)
    words = [mark, *vertex]
    number = texture[first:last]
    if (number >= 0).any():
        slash = np.where(number >= 0, WORD.type(b"/"[0]), WORD.type(0))
        words += [slash, *(np.where(number >= 0, word, WORD.type(0)) for word in digit_words(number + 1)[0])]
    newline = np.zeros(last - first, WORD)
    newline[starts[1:] - 1] = b"\n"[0]
    return compacted(np.column_stack([*words, newline]))
