"""Wavefront OBJ by blocks of lines: what defines vertices and texture vertices, and the elements.

It works on bytes: names may be in any encoding.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import FileFormatError
from .obj_elements import Elements, scan_elements
from .text_lines import TextLines, text_blocks

__all__ = ["ObjBlock", "obj_blocks", "wrong_texture"]

Ints = NDArray[np.int64]

LOWER_CASE = 0x20
HIDDEN_VERTEX = re.compile(rb"[^A-Za-z\s]*[vV][^A-Za-z\s]*(\s|$)")


@dataclass(frozen=True, eq=False)
class ObjBlock:
    """Some lines of an OBJ file: which define vertices and texture vertices, and the elements.

    Attributes
    ----------
    lines : TextLines
        The lines.
    is_v, is_vt : (L,) bool
        Which of them define a vertex, a texture vertex.
    elements : Elements
        Faces, and those polylines that have texture indices.
    is_face : (e,) bool
        Which elements are polygons of the mesh.
    vertex, texture : (c,) int64
        Vertex and texture vertex of every element corner, from 0; texture is -1 for none.
    """

    lines: TextLines
    is_v: NDArray[np.bool_]
    is_vt: NDArray[np.bool_]
    elements: Elements
    is_face: NDArray[np.bool_]
    vertex: Ints
    texture: Ints


def obj_blocks(path: Path, data: bytes, *, places: bool = False) -> Iterator[ObjBlock]:
    """The file by blocks of lines; ``places`` tells to find where in the text the elements' indices stand."""
    vertices = textures = 0
    for lines in text_blocks(path, data):
        is_v, is_vt, is_f = (lines.keyword_lines(word) for word in (b"v", b"vt", b"f"))
        _check_vertices(lines, is_v | is_vt | is_f)
        elements = scan_elements(lines, np.flatnonzero(is_f | _textured_polylines(lines)), places=places)
        vertex = _from_zero(elements.vertex, elements, is_v, vertices)
        texture = _from_zero(elements.texture, elements, is_vt, textures)
        wrong = (elements.texture < 0) & (texture < 0)
        if wrong.any():
            raise wrong_texture(lines, elements, wrong, None)
        texture[elements.texture == 0] = -1
        yield ObjBlock(lines, is_v, is_vt, elements, is_f[elements.line], vertex, texture)
        vertices += int(np.count_nonzero(is_v))
        textures += int(np.count_nonzero(is_vt))


def wrong_texture(lines: TextLines, elements: Elements, wrong: NDArray[np.bool_], count: int | None) -> FileFormatError:
    element = int(np.searchsorted(np.cumsum(elements.sizes), np.argmax(wrong), side="right"))
    known = "there are too few vt lines above" if count is None else f"the file has {count} vt lines"
    return lines.error(int(elements.line[element]), f"a texture index that does not exist ({known})")


def _check_vertices(lines: TextLines, known: NDArray[np.bool_]) -> None:
    """Refuse a vertex whose keyword is hidden by its case, a stray byte or a missing blank."""
    others = np.flatnonzero(~known)
    letter, second = (lines.text[lines.tokens[lines.first[others]] + k] | LOWER_CASE for k in (0, 1))
    plain = (letter >= ord("a")) & (letter <= ord("z"))
    normal = np.isin(second, np.frombuffer(b"np", np.uint8))
    for line in others[np.where(letter == ord("v"), ~normal, ~plain)].tolist():
        at = int(lines.tokens[lines.first[line]])
        if HIDDEN_VERTEX.match(lines.text[at : at + 16].tobytes()):
            raise lines.error(line, "a vertex that is not understood; it must begin with v and a blank")


def _textured_polylines(lines: TextLines) -> NDArray[np.bool_]:
    """The ``l`` lines that have texture indices: these must follow when texture vertices are renumbered."""
    polylines = lines.keyword_lines(b"l")
    for i in np.flatnonzero(polylines).tolist():
        polylines[i] = b"/" in lines.text[lines.starts[i] : lines.ends[i]].tobytes()
    return polylines


def _from_zero(written: Ints, elements: Elements, defines: NDArray[np.bool_], before: int) -> Ints:
    """Indices from 0; a negative one counts back from the last that is defined above the element's line."""
    index = written - 1
    if (written < 0).any():
        above = before + np.repeat(np.cumsum(defines)[elements.line], elements.sizes)
        index = np.where(written < 0, above + written, index)
        index[(written < 0) & (index < 0)] = -1
    return index
