"""Wavefront OBJ, read with its source lines so that the writer can change the texture indices alone.

No library keeps both the corner indices and the lines they stand on, hence this reader. It works on bytes:
names may be in any encoding.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from conformal_uv.files.checks import checked_mesh
from conformal_uv.files.mesh_file import MeshFile
from conformal_uv.files.obj_elements import Elements, scan_elements
from conformal_uv.files.text_lines import TextLines
from conformal_uv.mesh.polygons import PolygonMesh

__all__ = ["ObjSource", "parse_obj", "read_obj"]

Ints = NDArray[np.int64]

LOWER_CASE = 0x20
HIDDEN_VERTEX = re.compile(rb"[^A-Za-z\s]*[vV][^A-Za-z\s]*(\s|$)")


@dataclass(frozen=True, eq=False)
class ObjSource:
    """An OBJ file and the places in it that a new parameterization changes.

    Attributes
    ----------
    data : bytes
        The file.
    mesh : PolygonMesh
        Its polygons.
    elements : Elements
        Faces, and those polylines that have texture indices.
    is_face : (e,) bool
        Which elements are polygons of the mesh.
    texture : (c,) int64
        Texture vertex of every element corner, from 0; -1 for none.
    texture_lines : (t, 2) int64
        Span of each ``vt`` line.
    first_element : int
        Where the first element's line begins.
    """

    data: bytes
    mesh: PolygonMesh
    elements: Elements
    is_face: NDArray[np.bool_]
    texture: Ints
    texture_lines: Ints
    first_element: int


def read_obj(path: Path, data: bytes) -> MeshFile:
    """Read an OBJ file: vertices, polygons and their texture coordinates."""
    source, corner_uv = parse_obj(path, data)
    return MeshFile(path, source.mesh, corner_uv, source)


def parse_obj(path: Path, data: bytes) -> tuple[ObjSource, NDArray[np.float64] | None]:
    """The content of an OBJ file, and the texture coordinates of its polygon corners."""
    lines = TextLines(path, data)
    is_v, is_vt = lines.keyword_lines(b"v"), lines.keyword_lines(b"vt")
    is_f = lines.keyword_lines(b"f")
    _check_vertices(lines, is_v | is_vt | is_f)
    elements = scan_elements(lines, np.flatnonzero(is_f | _textured_polylines(lines)))
    is_face = is_f[elements.line]
    V = lines.floats(np.flatnonzero(is_v), 1, 3, 3)
    vt = lines.floats(np.flatnonzero(is_vt), 1, 2, 1)
    vertex = _from_zero(elements.vertex, elements, is_v)
    texture = np.where(elements.texture == 0, -1, _from_zero(elements.texture, elements, is_vt))
    _check_texture(lines, elements, texture, len(vt))
    face_corner = np.repeat(is_face, elements.sizes)
    face_lines = elements.line[is_face]
    mesh = checked_mesh(
        path,
        V,
        vertex[face_corner],
        elements.sizes[is_face],
        lambda face: f"line {lines.number(int(face_lines[face]))}",
    )
    spans = np.stack([lines.starts[is_vt], np.minimum(lines.ends[is_vt], len(data))], axis=1)
    source = ObjSource(data, mesh, elements, is_face, texture, spans, int(lines.starts[elements.line[0]]))
    return source, _corner_uv(vt, texture[face_corner])


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


def _from_zero(written: Ints, elements: Elements, defines: NDArray[np.bool_]) -> Ints:
    """Indices from 0; a negative one counts back from the last that is defined above the element's line."""
    index = written - 1
    if (written < 0).any():
        above = np.repeat(np.cumsum(defines)[elements.line], elements.sizes)
        index = np.where(written < 0, above + written, index)
        index[(written < 0) & (index < 0)] = -1
    return index


def _check_texture(lines: TextLines, elements: Elements, texture: Ints, count: int) -> None:
    wrong = np.flatnonzero((elements.texture != 0) & ((texture < 0) | (texture >= count)))
    if len(wrong):
        element = int(np.searchsorted(np.cumsum(elements.sizes), wrong[0], side="right"))
        raise lines.error(
            int(elements.line[element]), f"a texture index that does not exist (the file has {count} vt lines)"
        )


def _corner_uv(vt: NDArray[np.float64], texture: Ints) -> NDArray[np.float64] | None:
    if (texture < 0).all():
        return None
    return np.concatenate([vt, [[np.nan, np.nan]]])[texture]
