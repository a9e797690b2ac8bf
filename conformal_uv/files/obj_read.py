"""Wavefront OBJ, read with its source lines so that the writer can change the texture indices alone.

No library keeps both the corner indices and the lines they stand on, hence this reader. It works on bytes:
names may be in any encoding.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from conformal_uv.errors import FileFormatError
from conformal_uv.files.checks import checked_mesh
from conformal_uv.files.mesh_file import MeshFile
from conformal_uv.files.obj_elements import Elements, scan_elements
from conformal_uv.files.text_lines import TextLines, text_blocks
from conformal_uv.files.text_numbers import in_32_bits
from conformal_uv.mesh.polygons import PolygonMesh

__all__ = ["ObjBlock", "ObjSource", "obj_blocks", "read_obj"]

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


@dataclass(frozen=True, eq=False)
class ObjSource:
    """An OBJ file; its lines are gone through again where a new parameterization is written.

    Attributes
    ----------
    path : Path
        Its name.
    data : bytes
        The file.
    mesh : PolygonMesh
        Its polygons.
    first_element : int
        Where the first element's line begins.
    textures_before : int
        Number of ``vt`` lines before it.
    has_texture : (p,) bool, optional
        Which polygons have a texture index; None where none has.
    textured_polyline : bool
        Whether a polyline has texture indices.
    """

    path: Path
    data: bytes
    mesh: PolygonMesh
    first_element: int
    textures_before: int = 0
    has_texture: NDArray[np.bool_] | None = None
    textured_polyline: bool = False


def read_obj(path: Path, data: bytes) -> MeshFile:
    """Read an OBJ file: vertices, polygons and their texture coordinates."""
    V, vt, corners, sizes, textures = ([] for _ in range(5))
    first_element = textures_before = -1
    textured_polyline = False
    counted = 0
    most = -1
    for block in obj_blocks(path, data):
        lines, elements = block.lines, block.elements
        V.append(lines.floats(np.flatnonzero(block.is_v), 1, 3, 3))
        vt.append(lines.floats(np.flatnonzero(block.is_vt), 1, 2, 1))
        most = max(most, int(block.texture.max(initial=-1)))
        if first_element < 0 and len(elements.line):
            first_element = lines.begin + int(lines.starts[elements.line[0]])
            textures_before = counted + int(np.count_nonzero(block.is_vt[: elements.line[0]]))
        counted += len(vt[-1])
        of_face = np.repeat(block.is_face, elements.sizes)
        textured_polyline |= bool((block.texture[~of_face] >= 0).any())
        corners.append(in_32_bits(block.vertex[of_face]))
        sizes.append(in_32_bits(elements.sizes[block.is_face]))
        textures.append(in_32_bits(block.texture[of_face]) if elements.texture.any() else None)
    if most >= counted:
        raise _no_texture(path, data, counted)
    mesh = checked_mesh(
        path,
        np.concatenate(V),
        np.concatenate(corners, dtype=np.int64),
        np.concatenate(sizes, dtype=np.int64),
        lambda face: f"line {_line_of(path, data, face)}",
    )
    if all(part is None or part.max(initial=-1) < 0 for part in textures):
        source = ObjSource(path, data, mesh, first_element, textures_before, None, textured_polyline)
        return MeshFile(path, mesh, None, source)
    parts = [np.full(len(c), -1) if t is None else t for t, c in zip(textures, corners, strict=True)]
    texture = np.concatenate(parts)
    has = np.maximum.reduceat(texture, mesh.starts[:-1]) >= 0
    source = ObjSource(path, data, mesh, first_element, textures_before, has, textured_polyline)
    return MeshFile(path, mesh, np.concatenate([*vt, [[np.nan, np.nan]]])[texture], source)


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
            raise _wrong_texture(lines, elements, wrong, None)
        texture[elements.texture == 0] = -1
        yield ObjBlock(lines, is_v, is_vt, elements, is_f[elements.line], vertex, texture)
        vertices += int(np.count_nonzero(is_v))
        textures += int(np.count_nonzero(is_vt))


def _line_of(path: Path, data: bytes, face: int) -> int:
    """The line of a face, from 1."""
    for block in obj_blocks(path, data):
        of_faces = block.elements.line[block.is_face]
        if face < len(of_faces):
            return block.lines.number(int(of_faces[face]))
        face -= len(of_faces)
    raise IndexError(face)


def _no_texture(path: Path, data: bytes, count: int) -> FileFormatError:
    """The refusal of the first element with a texture vertex beyond the last."""
    for block in obj_blocks(path, data):
        if (block.texture >= count).any():
            return _wrong_texture(block.lines, block.elements, block.texture >= count, count)
    raise IndexError(count)


def _wrong_texture(
    lines: TextLines, elements: Elements, wrong: NDArray[np.bool_], count: int | None
) -> FileFormatError:
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
