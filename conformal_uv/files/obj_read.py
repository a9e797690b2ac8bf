"""Wavefront OBJ, read so that the writer can go through its lines again and change the texture indices alone.

No library keeps both the corner indices and the lines they stand on, hence this reader.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import FileFormatError
from ..mesh.polygons import PolygonMesh
from .checks import checked_mesh
from .mesh_file import MeshFile
from .obj_blocks import obj_blocks, wrong_texture
from .text_numbers import in_32_bits

__all__ = ["ObjSource", "read_obj"]


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
    first_element, before, counted, most = -1, 0, 0, -1
    textured_polyline = False
    for block in obj_blocks(path, data):
        lines, elements = block.lines, block.elements
        V.append(lines.floats(np.flatnonzero(block.is_v), 1, 3, 3))
        vt.append(lines.floats(np.flatnonzero(block.is_vt), 1, 2, 1))
        if first_element < 0 and len(elements.line):
            first_element = lines.begin + int(lines.starts[elements.line[0]])
            before = counted + int(np.count_nonzero(block.is_vt[: elements.line[0]]))
        counted += len(vt[-1])
        most = max(most, int(block.texture.max(initial=-1)))
        of_face = np.repeat(block.is_face, elements.sizes)
        textured_polyline |= bool((block.texture[~of_face] >= 0).any())
        corners.append(in_32_bits(block.vertex[of_face]))
        sizes.append(in_32_bits(elements.sizes[block.is_face]))
        textures.append(in_32_bits(block.texture[of_face]) if elements.texture.any() else None)
    if most >= counted:
        raise _no_texture(path, data, counted)
    every, size = (np.concatenate(parts, dtype=np.int64) for parts in (corners, sizes))
    mesh = checked_mesh(path, np.concatenate(V), every, size, lambda face: f"line {_line_of(path, data, face)}")
    texture = _joined(textures, corners)
    has = None if texture is None else np.maximum.reduceat(texture, mesh.starts[:-1]) >= 0
    uv = None if texture is None else np.concatenate([*vt, [[np.nan, np.nan]]])[texture]
    return MeshFile(path, mesh, uv, ObjSource(path, data, mesh, first_element, before, has, textured_polyline))


def _joined(textures: list[NDArray[np.int32] | None], corners: list[NDArray[np.int32]]) -> NDArray[np.int32] | None:
    """The texture vertices of all blocks' corners; None where none has any."""
    if all(part is None or part.max(initial=-1) < 0 for part in textures):
        return None
    whole = [np.full(len(c), -1, np.int32) if t is None else t for t, c in zip(textures, corners, strict=True)]
    return np.concatenate(whole)


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
            return wrong_texture(block.lines, block.elements, block.texture >= count, count)
    raise IndexError(count)
