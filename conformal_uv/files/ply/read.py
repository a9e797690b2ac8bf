"""PLY files, read: the mesh, its texture coordinates, and the rest in the file's own bytes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import FileFormatError
from ...mesh.polygons import PolygonMesh
from ..checks import checked_mesh
from ..mesh_file import MeshFile
from .header import PlyProperty, check_counts, read_header, unix_text
from .source import PlyRows, PlySource, rows_of

__all__ = ["INDEX_LISTS", "VERTEX_UV", "WEDGE_UV", "read_ply"]

INDEX_LISTS = ("vertex_indices", "vertex_index")
VERTEX_UV = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"))
WEDGE_UV = "texcoord"

Floats = NDArray[np.float64]


def read_ply(path: Path, data: bytes) -> MeshFile:
    """Read a PLY file: vertices, polygons, texture coordinates of vertices or of polygon corners."""
    data = unix_text(data)
    header, begin = read_header(path, data)
    check_counts(path, header, len(data) - begin)
    rows = rows_of(path, data, begin, header)
    by_name = {r.element.name: r for r in rows}
    if "vertex" not in by_name or "face" not in by_name:
        raise FileFormatError(f"{path}: no 'vertex' or no 'face' element; save the mesh with its faces")
    vertex, face = by_name["vertex"], by_name["face"]
    axes = [vertex.element.property(axis) for axis in "xyz"]
    index = next((p for n in INDEX_LISTS if (p := face.element.property(n, is_list=True))), None)
    xyz = [p for p in axes if p is not None]
    if index is None or len(xyz) < 3:
        raise FileFormatError(f"{path}: vertices need x, y, z and faces a list {' or '.join(INDEX_LISTS)}")
    if index.type[0] == "f":
        raise FileFormatError(f"{path}: the faces' vertex indices are not integers; export it again")
    wedge = face.element.property(WEDGE_UV, is_list=True)
    pair = next((found for names in VERTEX_UV if len(found := _scalars(vertex, names)) == 2), [])
    columns = vertex.columns(xyz + ([] if wedge else pair))
    (corners, sizes), *wedges = face.lists([index] + ([wedge] if wedge else []))
    V = _stacked(columns[:3])
    mesh = checked_mesh(path, V, corners, sizes)
    uv = _wedge_uv(path, mesh, *wedges[0]) if wedges else None
    if len(columns) > 3:
        uv = _stacked(columns[3:])[mesh.corners]
    return MeshFile(path, mesh, uv, PlySource(data, header, rows, mesh))


def _scalars(rows: PlyRows, names: tuple[str, ...]) -> list[PlyProperty]:
    return [p for name in names if (p := rows.element.property(name)) is not None]


def _stacked(columns: list[NDArray[Any]]) -> Floats:
    """Columns side by side as doubles."""
    table = np.empty((len(columns[0]), len(columns)))
    for k, column in enumerate(columns):
        table[:, k] = column
    return table


def _wedge_uv(path: Path, mesh: PolygonMesh, values: NDArray[Any], counts: NDArray[np.int64]) -> Floats | None:
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
