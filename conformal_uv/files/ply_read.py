"""PLY (Stanford), text or binary, through plyfile."""

from __future__ import annotations

import io
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from conformal_uv.errors import FileFormatError
from conformal_uv.files.checks import checked_mesh, foreign_parser, missing_library
from conformal_uv.files.mesh_file import MeshFile
from conformal_uv.files.ply_header import PlyElementHeader, check_counts, read_ply_header, unix_text
from conformal_uv.mesh.polygons import PolygonMesh

__all__ = ["INDEX_LISTS", "VERTEX_UV", "WEDGE_UV", "PlySource", "read_ply"]

INDEX_LISTS = ("vertex_indices", "vertex_index")
VERTEX_UV = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"))
WEDGE_UV = "texcoord"

Floats = NDArray[np.float64]


class PlySource:
    """The content of a PLY file (a ``plyfile.PlyData``) beside the mesh that was made of it."""

    def __init__(self, data: Any, mesh: PolygonMesh) -> None:
        self.data = data
        self.mesh = mesh


def read_ply(path: Path, data: bytes) -> MeshFile:
    """Read a PLY file: vertices, polygons, texture coordinates of vertices or of polygon corners."""
    data = unix_text(data)
    elements, text, begin = read_ply_header(path, data)
    check_counts(path, elements, len(data) - begin)
    with foreign_parser(path, "PLY"):
        ply = _parsed(path, data, elements, text)
    if "vertex" not in ply or "face" not in ply:
        raise FileFormatError(f"{path}: no 'vertex' or no 'face' element; save the mesh with its faces")
    vertex, face = ply["vertex"].data, ply["face"].data
    name = next((name for name in INDEX_LISTS if name in ply["face"]), None)
    if name is None or not {"x", "y", "z"} <= set(vertex.dtype.names or ()):
        raise FileFormatError(f"{path}: vertices need x, y, z and faces a list {' or '.join(INDEX_LISTS)}")
    with foreign_parser(path, "PLY"):
        V = np.stack([vertex[axis].astype(np.float64) for axis in "xyz"], axis=1)
        corners, sizes = _list_values(face[name])
        if corners.dtype.kind not in "iu":
            raise FileFormatError(f"{path}: the faces' vertex indices are not integers; export it again")
    mesh = checked_mesh(path, V, corners.astype(np.int64), sizes)
    with foreign_parser(path, "PLY"):
        corner_uv = _corner_uv(path, vertex, face, mesh)
    return MeshFile(path, mesh, corner_uv, PlySource(ply, mesh))


def _parsed(path: Path, data: bytes, elements: list[PlyElementHeader], text: bool) -> Any:
    """The file as plyfile sees it: mapped at once if all faces have one size, else row by row."""
    try:
        import plyfile
    except ImportError as error:
        raise missing_library("plyfile", ".ply") from error
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # numpy warns of an empty list in a text file
        for size in () if text or path.suffix.lower() != ".ply" else (3, 4):  # mapped: a file of its own
            known = {e.name: dict.fromkeys(e.lists, size) for e in elements}
            if WEDGE_UV in known.get("face", {}):
                known["face"][WEDGE_UV] = 2 * size
            try:
                ply = plyfile.PlyData.read(str(path), known_list_len=known)
            except plyfile.PlyElementParseError:
                continue
            for element in ply:
                element.data = np.array(element.data)  # lets go of the file: it may be replaced next
            return ply
        # From memory, not from the file: a damaged list length then reads what is there, allocates no more.
        return plyfile.PlyData.read(io.BytesIO(data))


def _list_values(rows: NDArray[Any]) -> tuple[NDArray[Any], NDArray[np.int64]]:
    """A list property as its values run together and the length of each list."""
    if rows.dtype != object:
        return rows.reshape(-1), np.full(len(rows), rows.shape[1], np.int64)
    sizes = np.fromiter(map(len, rows), np.int64, len(rows))
    return np.concatenate([*rows, np.empty(0, rows[0].dtype if len(rows) else np.int64)]), sizes


def _corner_uv(path: Path, vertex: NDArray[Any], face: NDArray[Any], mesh: PolygonMesh) -> Floats | None:
    names = face.dtype.names or ()
    if WEDGE_UV in names:
        values, counts = _list_values(face[WEDGE_UV])
        wrong = np.flatnonzero((counts != 2 * mesh.sizes) & (counts > 0))
        if len(wrong):
            f, size = int(wrong[0]), int(mesh.sizes[wrong[0]])
            raise FileFormatError(
                f"{path}, face {f}: {int(counts[f])} texture numbers for {size} corners; "
                "two each are needed, or none; export it again"
            )
        if not counts.any():
            return None
        uv = np.full((len(mesh.corners), 2), np.nan)
        uv[np.repeat(counts > 0, mesh.sizes)] = values.astype(np.float64).reshape(-1, 2)
        return uv
    for pair in VERTEX_UV:
        if set(pair) <= set(vertex.dtype.names or ()):
            return np.stack([vertex[axis].astype(np.float64) for axis in pair], axis=1)[mesh.corners]
    return None
