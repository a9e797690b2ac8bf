"""PLY: new texture coordinates beside everything else the file held, or a fresh binary file."""

from __future__ import annotations

from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from conformal_uv.files.checks import missing_library
from conformal_uv.files.corner_uv import filled_corner_uv, mapped_faces, vertex_uv
from conformal_uv.files.mesh_file import MeshFile
from conformal_uv.files.ply_read import VERTEX_UV, WEDGE_UV, PlySource
from conformal_uv.files.ply_rows import write_rows
from conformal_uv.mesh.polygons import PolygonMesh

__all__ = ["write_ply"]

Floats = NDArray[np.float64]

WRITTEN_UV = (("s", "t"), ("texture_u", "texture_v"))
"""The coordinates are stored under both names: as double, MeshLab reads only the second, others only the first."""


def write_ply(stream: BinaryIO, source: MeshFile, corner_uv: Floats) -> None:
    """Write ``source`` with new texture coordinates.

    They become vertex properties (double) where every vertex has one pair, else the face list texcoord (float),
    MeshLab's wedge coordinates, empty for a face that has none; without any there is no such list. The other
    elements and properties of a file that came from PLY stay, and so does its text or binary format.
    """
    try:
        import plyfile
    except ImportError as error:
        raise missing_library("plyfile", ".ply") from error
    mesh, origin = source.mesh, source.origin
    uv = filled_corner_uv(mesh, corner_uv, source.corner_uv)
    if isinstance(origin, PlySource) and origin.mesh is mesh:
        old = origin.data
        elements, text, order = list(old.elements), old.text, old.byte_order
    else:
        old, elements, text, order = None, _fresh(plyfile, mesh), False, "<"
    each = vertex_uv(mesh, uv)
    for k, element in enumerate(elements):
        added: dict[str, Any]
        if element.name == "vertex":
            added = {} if each is None else {name: each[:, k] for pair in WRITTEN_UV for k, name in enumerate(pair)}
            if source.original_vertex is not None:
                added["original_vertex"] = source.original_vertex.astype(np.int32)
            elements[k] = _changed(plyfile, element, [n for pair in VERTEX_UV for n in pair], added)
        elif element.name == "face":
            added = {} if each is not None or np.isnan(uv).all() else {WEDGE_UV: _wedges(mesh, uv)}
            elements[k] = _changed(plyfile, element, [WEDGE_UV], added)
    ply = plyfile.PlyData(elements, text=text, byte_order=order)
    if old is not None:
        ply.comments, ply.obj_info = old.comments, old.obj_info
    write_rows(stream, ply)


def _fresh(plyfile: Any, mesh: PolygonMesh) -> list[Any]:
    vertex = np.empty(len(mesh.V), [("x", "f8"), ("y", "f8"), ("z", "f8")])
    for k, axis in enumerate("xyz"):
        vertex[axis] = mesh.V[:, k]
    face = np.empty(len(mesh.sizes), [_list_field("vertex_indices", "i4", mesh.sizes)])
    _set_lists(face, "vertex_indices", mesh.corners.astype(np.int32), mesh.sizes)
    lengths = {"vertex_indices": _length_type(mesh.sizes)}
    return [plyfile.PlyElement.describe(vertex, "vertex"), plyfile.PlyElement.describe(face, "face", len_types=lengths)]


def _wedges(mesh: PolygonMesh, uv: Floats) -> tuple[NDArray[np.float32], NDArray[np.int64]]:
    """Values and lengths of the texcoord lists."""
    mapped = mapped_faces(mesh, uv)
    values = uv[np.repeat(mapped, mesh.sizes)].astype(np.float32).ravel()
    return values, np.where(mapped, 2 * mesh.sizes, 0)


def _changed(plyfile: Any, element: Any, dropped: list[str], added: dict[str, Any]) -> Any:
    """The element with properties dropped and added: arrays, or lists as (values, lengths)."""
    kept = [p for p in element.properties if p.name not in dropped]
    if len(kept) == len(element.properties) and not added:
        return element
    fields: list[Any] = [(p.name, *_field_type(element.data.dtype[p.name])) for p in kept]
    lists = {p.name: p for p in kept if isinstance(p, plyfile.PlyListProperty)}
    length_types = {name: p.len_dtype for name, p in lists.items()}
    value_types = {name: p.val_dtype for name, p in lists.items()}
    for name, value in added.items():
        if isinstance(value, tuple):
            fields.append(_list_field(name, "f4", value[1]))
            length_types[name], value_types[name] = _length_type(value[1]), "f4"
        else:
            fields.append((name, value.dtype))
    data = np.empty(element.count, fields)
    for p in kept:
        data[p.name] = element.data[p.name]
    for name, value in added.items():
        if isinstance(value, tuple):
            _set_lists(data, name, *value)
        else:
            data[name] = value
    return plyfile.PlyElement.describe(data, element.name, length_types, value_types, element.comments)


def _field_type(dtype: np.dtype[Any]) -> tuple[Any, ...]:
    return (dtype.base, dtype.shape) if dtype.shape else (dtype,)


def _list_field(name: str, value_type: str, lengths: NDArray[np.int64]) -> tuple[Any, ...]:
    """A field for lists: an array column if all have one length, else objects."""
    if len(lengths) and lengths[0] > 0 and (lengths == lengths[0]).all():
        return (name, value_type, (int(lengths[0]),))
    return (name, object)


def _length_type(lengths: NDArray[np.int64]) -> str:
    return "u1" if lengths.max(initial=0) <= 255 else "i4"


def _set_lists(data: NDArray[Any], name: str, values: NDArray[Any], lengths: NDArray[np.int64]) -> None:
    if not data.dtype[name].hasobject:
        data[name] = values.reshape(len(data), -1)
        return
    ends = np.cumsum(lengths).tolist()
    for k, (begin, end) in enumerate(zip([0, *ends], ends, strict=False)):
        data[name][k] = values[begin:end]
