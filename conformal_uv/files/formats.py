"""The file formats, by suffix."""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..errors import FileFormatError
from .atomic import replaced_file
from .checks import file_bytes
from .corner_uv import checked_corner_uv, split_at_seams
from .mesh_file import MeshFile
from .npz import read_npz, write_npz
from .obj_read import read_obj
from .obj_write import write_obj
from .off import read_off
from .other_formats import (
    MESHIO_SUFFIXES,
    TRIMESH_SUFFIXES,
    read_with_meshio,
    read_with_trimesh,
)
from .places import STANDARD_STREAM, check_place, is_stream
from .ply import read_ply, write_ply
from .stl import read_stl

__all__ = ["READABLE", "WRITABLE", "check_writable", "read_mesh", "write_mesh"]

_READERS: dict[str, Callable[[Path, bytes], MeshFile]] = {
    ".obj": read_obj,
    ".ply": read_ply,
    ".off": read_off,
    ".stl": read_stl,
    ".npz": read_npz,
    **dict.fromkeys(TRIMESH_SUFFIXES, read_with_trimesh),
    **dict.fromkeys(MESHIO_SUFFIXES, read_with_meshio),
}
PACKED = (".obj", ".ply", ".off", ".stl")  # also read with .gz behind
_WRITERS: dict[str, Callable[[BinaryIO, MeshFile, NDArray[np.float64]], None]] = {
    ".obj": write_obj,
    ".ply": write_ply,
    ".npz": write_npz,
}
READABLE = tuple(_READERS)
WRITABLE = tuple(_WRITERS)


def read_mesh(path: str | os.PathLike[str], *, format: str | None = None) -> MeshFile:
    """Read a mesh by its suffix: OBJ, PLY, OFF, STL (also packed: .obj.gz), npz, GLB, glTF, 3MF, VTK, VTU.

    Parameters
    ----------
    path : path-like
        The file; ``-`` is standard input.
    format : str, optional
        Of standard input, as a suffix without its dot; by default "obj".

    Returns
    -------
    MeshFile
        Polygons as they stand in the file, and its texture coordinates by corner.

    Raises
    ------
    FileFormatError
        No such file, a suffix that is not known, or content that is damaged or is no mesh.
    MissingDependencyError
        The library for this format is not installed.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if str(path) == STANDARD_STREAM:
        suffix = f".{format or 'obj'}"
    elif suffix == ".gz" and Path(path.stem).suffix.lower() in PACKED:
        suffix = Path(path.stem).suffix.lower()
    reader = _READERS.get(suffix)
    if reader is None:
        raise FileFormatError(
            f"{path}: files of the type {suffix!r} are not read; use {', '.join(READABLE)}.{_converters()}"
        )
    return reader(path, file_bytes(path))


def _converters() -> str:
    """What can make a file readable."""
    if importlib.util.find_spec("pymeshlab") is not None:
        return " conformal-uv-meshlab reads what MeshLab reads (DAE, FBX, X3D, 3DS ...)"
    return ' Blender, MeshLab or conformal-uv-meshlab (pip install "conformal-uv[meshlab]") can convert it'


def write_mesh(
    path: str | os.PathLike[str],
    source: MeshFile,
    *,
    corner_uv: NDArray[np.float64],
    split: bool = False,
    format: str | None = None,
) -> None:
    """Write a mesh with new texture coordinates: OBJ, PLY or npz, by the file's suffix.

    A file of the same format as the source's keeps everything else that was in it. The target is replaced in
    one step, so it may be the source; after an error it is as it was. A device, a FIFO or standard output (``-``) is
    written into.

    Parameters
    ----------
    path : path-like
        The file to write.
    source : MeshFile
        The mesh, as `read_mesh` gave it.
    corner_uv : (k, 2) float
        Texture coordinates of every polygon corner. A face with NaN at a corner keeps those that the source
        had, or has none.
    split : bool
        Write a vertex once for each of its texture coordinates, so that programs which know one a vertex (Blender,
        open3d and meshio in PLY) see them all. PLY and npz have the source's vertices as the property or array
        ``original_vertex``; nothing else of the source's file is kept.
    format : str, optional
        As a suffix without its dot, where the path has none that is known; "obj" for standard output.

    Raises
    ------
    FileFormatError
        The file can not be written there, or not in this format.
    OptionError, NonFiniteError
        ``corner_uv`` does not fit the mesh or is infinite somewhere.
    MissingDependencyError
        The library for this format is not installed.
    """
    check_writable(path, format=format)
    uv = checked_corner_uv(source.mesh, corner_uv)
    if split:
        source, uv = split_at_seams(source, uv)
    with replaced_file(path) as stream:
        _WRITERS[_written_suffix(path, format)](stream, source, uv)


def check_writable(path: str | os.PathLike[str], *, format: str | None = None) -> None:
    """Refuse, before any work is done, a name that `write_mesh` could not write.

    Raises
    ------
    FileFormatError
        The suffix is not that of a format written here, the folder does not exist or is write-protected, or
        the file is a folder or write-protected.
    """
    suffix = _written_suffix(path, format)
    if suffix not in _WRITERS:
        raise FileFormatError(f"{path}: files of the type {suffix!r} are not written; use {', '.join(WRITABLE)}")
    check_place(path)


def _written_suffix(path: str | os.PathLike[str], format: str | None) -> str:
    suffix = Path(path).suffix.lower()
    if suffix in _WRITERS or not (format or is_stream(path)):
        return suffix
    return f".{(format or 'obj').lower().removeprefix('.')}"
