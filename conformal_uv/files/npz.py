"""Meshes as numpy archives: V with F, or with corners and starts; uv or corner_uv."""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..errors import FileFormatError
from .checks import ALWAYS_TAKEN, DAMAGED, MOST_PACKED, checked_mesh, foreign_parser
from .corner_uv import filled_corner_uv, vertex_uv
from .mesh_file import MeshFile

__all__ = ["read_npz", "write_npz"]

NAMES = ("V", "F", "corners", "starts", "uv", "corner_uv")


def read_npz(path: Path, data: bytes) -> MeshFile:
    """Read an archive of V (n, 3) and F (m, 3) (or (m, s) polygons), or V, corners (k,) and starts (p + 1,).

    Texture coordinates are taken from corner_uv (k, 2), else from uv (n, 2).
    """
    with foreign_parser(path, "npz"), np.load(io.BytesIO(data), allow_pickle=False) as archive:
        if not isinstance(archive, np.lib.npyio.NpzFile):
            raise FileFormatError(f"{path}: one array, not an archive; save V and F with numpy.savez")
        claimed = sum(info.file_size for info in archive.zip.infolist() if info.filename.removesuffix(".npy") in NAMES)
        if claimed > max(MOST_PACKED * len(data), ALWAYS_TAKEN):
            raise FileFormatError(
                f"{path}: {len(data)} bytes that claim to hold {claimed}; the archive is damaged or no mesh"
            )
        arrays = {name: _array(path, archive, name) for name in NAMES if name in archive.files}
    V = _numbers(path, arrays, "V", "(n, 3)")
    if "F" in arrays and "corners" not in arrays:
        F = _whole(path, arrays, "F", 2)
        corners, sizes = F.reshape(-1), np.full(len(F), F.shape[1], np.int64)
    else:
        corners, starts = _whole(path, arrays, "corners", 1), _whole(path, arrays, "starts", 1)
        sizes = np.diff(starts)
        if not len(starts) or starts[0] != 0 or starts[-1] != len(corners) or (sizes < 0).any():
            raise FileFormatError(f"{path}: 'starts' must ascend from 0 to {len(corners)}, the corner count")
    mesh = checked_mesh(path, V, corners, sizes)
    uv = None
    if "corner_uv" in arrays:
        uv = _numbers(path, arrays, "corner_uv", "(k, 2)", len(corners))
    elif "uv" in arrays:
        uv = _numbers(path, arrays, "uv", "(n, 2)", len(V))[corners]
    return MeshFile(path, mesh, uv)


def write_npz(stream: BinaryIO, source: MeshFile, corner_uv: NDArray[np.float64]) -> None:
    """Write V, corners, starts, corner_uv; F if all faces are triangles; uv if each vertex has one pair."""
    mesh = source.mesh
    uv = filled_corner_uv(mesh, corner_uv, source.corner_uv)
    arrays = {"V": mesh.V, "corners": mesh.corners, "starts": mesh.starts, "corner_uv": uv}
    if (mesh.sizes == 3).all():
        arrays["F"] = mesh.corners.reshape(-1, 3)
    each = vertex_uv(mesh, uv)
    if each is not None:
        arrays["uv"] = each
    if source.original_vertex is not None:
        arrays["original_vertex"] = source.original_vertex
    np.savez(stream, allow_pickle=False, **arrays)


def _array(path: Path, archive: Mapping[str, NDArray[Any]], name: str) -> NDArray[Any]:
    """One array, which numpy allocates by its header and reads from what is there."""
    try:
        array = archive[name]
    except MemoryError as error:
        raise FileFormatError(f"{path}: {name!r} claims more numbers than fit into memory; {DAMAGED}") from error
    except ValueError as error:  # objects, or no header
        raise FileFormatError(f"{path}: {name!r}: {error}; save plain arrays of real numbers") from error
    if array.dtype.kind not in "iuf":
        raise FileFormatError(f"{path}: {name!r} holds {array.dtype}, not real numbers; save plain numpy arrays")
    return array


def _present(path: Path, arrays: dict[str, NDArray[Any]], name: str) -> NDArray[Any]:
    if name not in arrays:
        raise FileFormatError(
            f"{path}: no array {name!r}; save V and F, or V, corners and starts "
            f"(found: {', '.join(arrays) or 'none of these'})"
        )
    return arrays[name]


def _numbers(
    path: Path, arrays: dict[str, NDArray[Any]], name: str, shape: str, rows: int | None = None
) -> NDArray[np.float64]:
    array = _present(path, arrays, name)
    if array.ndim != 2 or array.shape[1] != int(shape[-2]) or rows not in (None, len(array)):
        raise FileFormatError(
            f"{path}: {name!r} has the shape {array.shape}; it must be {shape}"
            + ("" if rows is None else f" with {rows} rows")
        )
    return array.astype(np.float64)


def _whole(path: Path, arrays: dict[str, NDArray[Any]], name: str, ndim: int) -> NDArray[np.int64]:
    array = _present(path, arrays, name)
    if array.ndim != ndim or array.dtype.kind not in "iu":
        raise FileFormatError(
            f"{path}: {name!r} has the shape {array.shape} and type {array.dtype}; "
            f"it must be {ndim}-dimensional, of integers"
        )
    return array.astype(np.int64)
