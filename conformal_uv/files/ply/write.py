"""PLY files, written: new texture coordinates beside everything else the file held, or a fresh binary file."""

from __future__ import annotations

from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from ...mesh.polygons import PolygonMesh
from ..corner_uv import filled_corner_uv, mapped_faces, vertex_uv
from ..mesh_file import MeshFile
from .change import Added, changed_rows
from .header import NAMES, PlyProperty, read_header
from .lists import packed
from .read import VERTEX_UV, WEDGE_UV
from .source import PlySource, rows_of

__all__ = ["write_ply"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

WRITTEN_UV = (("s", "t"), ("texture_u", "texture_v"))
"""The coordinates are stored under both names: as double, MeshLab reads only the second, others only the first."""


def write_ply(stream: BinaryIO, source: MeshFile, corner_uv: Floats) -> None:
    """Write ``source`` with new texture coordinates.

    They become vertex properties (double) where every vertex has one pair, else the face list texcoord (float),
    MeshLab's wedge coordinates, empty for a face that has none; without any there is no such list. The other
    elements and properties of a file that came from PLY stay, and so does its text or binary format.
    """
    mesh, origin = source.mesh, source.origin
    uv = filled_corner_uv(mesh, corner_uv, source.corner_uv)
    if not isinstance(origin, PlySource) or origin.mesh is not mesh:
        origin = _fresh(source)
    dropped = {"vertex": [name for pair in VERTEX_UV for name in pair], "face": [WEDGE_UV]}
    added: dict[str, list[Added]] = {"vertex": [], "face": []}
    each = vertex_uv(mesh, uv)
    if each is not None:
        added["vertex"] = [
            Added(PlyProperty(name, "f8"), each[:, k]) for pair in WRITTEN_UV for k, name in enumerate(pair)
        ]
    elif not np.isnan(uv).all():
        added["face"].append(_wedges(mesh, uv))
    if source.original_vertex is not None:
        dropped["vertex"].append("original_vertex")
        added["vertex"].append(Added(PlyProperty("original_vertex", "i4"), source.original_vertex.astype(np.int32)))
    stream.write(origin.header.edited(dropped, {name: [a.property for a in new] for name, new in added.items()}))
    for rows in origin.rows:
        name = rows.element.name
        for part in changed_rows(origin.data, rows, origin.header.order, dropped.get(name, []), added.get(name, [])):
            stream.write(part)


def _wedges(mesh: PolygonMesh, uv: Floats) -> Added:
    """The texcoord lists."""
    mapped = mapped_faces(mesh, uv)
    lengths = np.where(mapped, 2 * mesh.sizes, 0)
    values = uv[np.repeat(mapped, mesh.sizes)].astype(np.float32).ravel()
    return Added(PlyProperty(WEDGE_UV, "f4", _length_type(lengths)), values, lengths)


def _fresh(source: MeshFile) -> PlySource:
    """A binary file of this mesh, without texture coordinates."""
    mesh = source.mesh
    kind = _length_type(mesh.sizes)
    lines = [
        "ply",
        "format binary_little_endian 1.0",
        f"element vertex {len(mesh.V)}",
        *(f"property double {axis}" for axis in "xyz"),
        f"element face {len(mesh.sizes)}",
        f"property list {NAMES[kind]} int vertex_indices",
        "end_header\n",
    ]
    faces = packed(mesh.corners, mesh.sizes, "<" + kind, "<i4")[0]
    data = b"".join(("\n".join(lines).encode("ascii"), mesh.V.astype("<f8").tobytes(), faces.tobytes()))
    header, begin = read_header(source.path, data)
    return PlySource(data, header, rows_of(source.path, data, begin, header), mesh)


def _length_type(lengths: Ints) -> str:
    return "u1" if lengths.max(initial=0) <= 255 else "i4"
