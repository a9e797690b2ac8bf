"""A PLY file's content: its header and the rows of its elements, in the file's own bytes."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ...mesh.polygons import PolygonMesh
from .binary_rows import EvenRows, UnevenRows, binary_rows
from .header import PlyHeader
from .text_rows import TextRows

__all__ = ["PlyRows", "PlySource", "rows_of"]

PlyRows = EvenRows | UnevenRows | TextRows
"""The rows of one element; ``columns`` and ``lists`` read properties when asked for."""


@dataclass(frozen=True, eq=False)
class PlySource:
    """The content of a PLY file beside the mesh that was made of it.

    Attributes
    ----------
    data : bytes
        The file (text with LF at its lines' ends).
    header : PlyHeader
        Its declarations.
    rows : list of PlyRows
        The rows of each element.
    mesh : PolygonMesh
        The mesh.
    """

    data: bytes
    header: PlyHeader
    rows: list[PlyRows]
    mesh: PolygonMesh


def rows_of(path: Path, data: bytes, begin: int, header: PlyHeader) -> list[PlyRows]:
    """The rows of every element."""
    rows: list[PlyRows] = []
    for element in header.elements:
        if header.order:
            rows.append(binary_rows(path, data, begin, element, header.order))
        else:
            rows.append(TextRows(path, data, begin, element))
        begin = rows[-1].end
    return rows
