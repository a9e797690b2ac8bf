"""Wavefront OBJ: new texture coordinates in an otherwise unchanged file, or a fresh file."""

from __future__ import annotations

from collections.abc import Iterator
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from .corner_uv import filled_corner_uv, mapped_faces, shared_uv
from .digits import whole_texts
from .float_texts import float_rows
from .mesh_file import MeshFile
from .obj_blocks import ObjBlock, obj_blocks
from .obj_fresh import write_fresh_obj
from .obj_read import ObjSource
from .splice import spliced
from .text_lines import TextLines

__all__ = ["patched_obj", "write_obj"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
_Pieces = tuple[Ints, Ints, Ints, NDArray[np.uint8]]

ROWS = 1 << 16  # lines written together


def write_obj(stream: BinaryIO, source: MeshFile, corner_uv: Floats) -> None:
    """Write ``source`` with new texture coordinates; its own lines are kept if it came from an OBJ file."""
    origin = source.origin
    if not isinstance(origin, ObjSource) or origin.mesh is not source.mesh:
        write_fresh_obj(stream, source.mesh, filled_corner_uv(source.mesh, corner_uv, source.corner_uv))
        return
    for part in patched_obj(origin, corner_uv):
        stream.write(part)


def patched_obj(source: ObjSource, corner_uv: Floats) -> Iterator[bytes]:
    """The file with the texture coordinates of its polygon corners replaced.

    Only ``vt`` lines and the texture indices of elements change. The new ``vt`` lines stand before the first
    element. A face with a corner that is NaN keeps its texture indices; if any element does, the old ``vt``
    lines stay (else they go) and its indices count the new lines in.
    """
    mesh = source.mesh
    mapped = mapped_faces(mesh, corner_uv)
    new = np.flatnonzero(np.repeat(mapped, mesh.sizes)) if not mapped.all() else slice(None)
    number, example = shared_uv(mesh.corners[new], corner_uv[new])
    kept = source.textured_polyline or (source.has_texture is not None and bool((source.has_texture & ~mapped).any()))
    change = _Change(mapped, number, len(example), not kept, source.textures_before if kept else 0)
    for block in obj_blocks(source.path, source.data, places=True):
        here = source.first_element - block.lines.begin
        pieces = change.replaced(block)
        if 0 <= here < len(block.lines.text) - 1:
            yield _patched(block.lines, pieces, 0, here)
            yield from _vt_lines(source.data, corner_uv[new][example])
            yield _patched(block.lines, pieces, here, len(block.lines.text) - 1)
        else:
            yield _patched(block.lines, pieces, 0, len(block.lines.text) - 1)


class _Change:
    """What becomes of texture indices and vt lines, block after block."""

    def __init__(self, mapped: NDArray[np.bool_], number: Ints, added: int, drop: bool, earlier: int) -> None:
        self.mapped, self.number, self.added, self.drop, self.earlier = mapped, number, added, drop, earlier
        self.face = self.corner = 0

    def replaced(self, block: ObjBlock) -> _Pieces:
        """The next block's spans that change: begin, end, and the new texts."""
        lines, elements = block.lines, block.elements
        mapped = np.zeros(len(elements.sizes), dtype=bool)
        faces = int(np.count_nonzero(block.is_face))
        mapped[block.is_face] = self.mapped[self.face : self.face + faces]
        new = np.repeat(mapped, elements.sizes)
        target = block.texture + 1 + np.where(block.texture >= self.earlier, self.added, 0)
        count = int(np.count_nonzero(new))
        target[new] = self.number[self.corner : self.corner + count] + 1 + self.earlier
        self.face, self.corner = self.face + faces, self.corner + count
        changed = new | (block.texture >= 0)
        texts, lengths = whole_texts(target[changed], b"/")
        gone = block.is_vt if self.drop else np.zeros(len(lines.starts), dtype=bool)
        starts = np.concatenate([lines.starts[gone], elements.vertex_end[changed]])
        ends = np.concatenate([np.minimum(lines.ends[gone], len(lines.text) - 1), elements.texture_end[changed]])
        lengths = np.concatenate([np.zeros(len(starts) - len(lengths), np.int64), lengths])
        if gone.any():
            order = np.argsort(starts, kind="stable")
            starts, ends, lengths = starts[order], ends[order], lengths[order]
        return starts, ends, lengths, np.frombuffer(texts, np.uint8)


def _patched(lines: TextLines, pieces: _Pieces, begin: int, end: int) -> bytes:
    """The lines' bytes from ``begin`` to ``end`` with the spans that begin there replaced."""
    starts, ends, lengths, texts = pieces
    last = end == len(lines.text) - 1  # a file without a newline at its end has an index there
    some = slice(*np.searchsorted(starts, [begin, end + last]).tolist())
    at = np.concatenate([np.zeros(1, np.int64), np.cumsum(lengths)])
    text = lines.data[lines.begin + begin : lines.begin + end]
    return spliced(text, starts[some] - begin, ends[some] - begin, texts[at[some.start] : at[some.stop]], lengths[some])


def _vt_lines(data: bytes, uv: Floats) -> Iterator[bytes]:
    """Lines for these coordinates, with the shortest numbers that read back the same."""
    newline = data.find(b"\n")
    end = b"\n" if newline >= 0 else b"\r"
    if newline > 0 and data[newline - 1 : newline] == b"\r":
        end = b"\r\n"
    for begin in range(0, len(uv), ROWS):
        yield float_rows(uv[begin : begin + ROWS], b"vt", end)[0]
