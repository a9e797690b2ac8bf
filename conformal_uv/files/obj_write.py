"""Wavefront OBJ: new texture coordinates in an otherwise unchanged file, or a fresh file."""

from __future__ import annotations

from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from conformal_uv.files.corner_uv import filled_corner_uv, mapped_faces, shared_uv
from conformal_uv.files.mesh_file import MeshFile
from conformal_uv.files.obj_read import ObjSource, parse_obj
from conformal_uv.files.splice import decimal_texts, spliced
from conformal_uv.mesh.polygons import PolygonMesh

__all__ = ["patched_obj", "write_obj"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def write_obj(stream: BinaryIO, source: MeshFile, corner_uv: Floats) -> None:
    """Write ``source`` with new texture coordinates; its own lines are kept if it came from an OBJ file."""
    origin = source.origin
    if not isinstance(origin, ObjSource) or origin.mesh is not source.mesh:
        corner_uv = filled_corner_uv(source.mesh, corner_uv, source.corner_uv)
        origin = _fresh(source.mesh)
    stream.write(patched_obj(origin, corner_uv))


def patched_obj(source: ObjSource, corner_uv: Floats) -> bytes:
    """The file with the texture coordinates of its polygon corners replaced.

    Only ``vt`` lines and the texture indices of elements change. The new ``vt`` lines stand before the first
    element. A face with a corner that is NaN keeps its texture indices; if any element does, the old ``vt``
    lines stay (else they go) and its indices count the new lines in.
    """
    elements = source.elements
    face_corner = np.repeat(source.is_face, elements.sizes)
    mapped = np.zeros(len(face_corner), dtype=bool)
    mapped[face_corner] = np.repeat(mapped_faces(source.mesh, corner_uv), source.mesh.sizes)
    new = mapped[face_corner]
    number, example = shared_uv(source.mesh.corners[new], corner_uv[new])
    kept = ~mapped & (source.texture >= 0)
    drop = source.texture_lines if not kept.any() else source.texture_lines[:0]
    earlier = 0 if len(drop) else int((source.texture_lines[:, 0] < source.first_element).sum())
    target = source.texture + 1 + np.where(source.texture >= earlier, len(example), 0)
    target[mapped] = number + 1 + earlier
    return _replaced(source, _vt_lines(source.data, corner_uv[new][example]), drop, mapped | kept, target)


def _replaced(source: ObjSource, block: bytes, drop: Ints, changed: NDArray[np.bool_], target: Ints) -> bytes:
    """The file with the new vt lines in, old ones out, and texture indices set at the changed corners."""
    texts, lengths = decimal_texts(target[changed], b"/")
    at = np.array([source.first_element])
    starts = np.concatenate([drop[:, 0], at, source.elements.vertex_end[changed]])
    ends = np.concatenate([drop[:, 1], at, source.elements.texture_end[changed]])
    lengths = np.concatenate([np.zeros(len(drop), np.int64), [len(block)], lengths])
    order = np.argsort(starts, kind="stable")
    replacement = np.concatenate([np.frombuffer(block, np.uint8), texts])
    return spliced(source.data, starts[order], ends[order], replacement, lengths[order])


def _vt_lines(data: bytes, uv: Floats) -> bytes:
    """Lines for these coordinates, with the shortest numbers that read back the same."""
    newline = data.find(b"\n")
    end = "\n" if newline >= 0 else "\r"
    if newline > 0 and data[newline - 1 : newline] == b"\r":
        end = "\r\n"
    return ((f"vt %r %r{end}" * len(uv)) % tuple(uv.ravel().tolist())).encode("ascii")


def _fresh(mesh: PolygonMesh) -> ObjSource:
    """An OBJ file of this mesh, without texture coordinates."""
    vertices = ("v %r %r %r\n" * len(mesh.V)) % tuple(mesh.V.ravel().tolist())
    texts, lengths = decimal_texts(mesh.corners + 1, b" ")
    at = np.concatenate([np.zeros(1, np.int64), np.cumsum(lengths)])[mesh.starts]
    breaks = np.frombuffer(b"f" + b"\nf" * (len(mesh.starts) - 2) + b"\n", np.uint8)
    widths = np.r_[1, np.full(len(at) - 2, 2), 1]
    faces = spliced(texts.tobytes(), at, at, breaks, widths)
    return parse_obj(Path("fresh.obj"), vertices.encode("ascii") + faces)[0]
