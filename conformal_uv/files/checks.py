"""What every reader checks, and the form of its refusals."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from conformal_uv.errors import ConformalUVError, FileFormatError, MissingDependencyError
from conformal_uv.mesh.polygons import PolygonMesh

__all__ = ["checked_mesh", "file_bytes", "foreign_parser", "missing_library"]

DAMAGED = "the file is damaged or cut short; export it again"


def file_bytes(path: Path) -> bytes:
    """The file's content; every failure is a FileFormatError."""
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise FileFormatError(f"{path}: no such file; check the name and the folder") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise FileFormatError(f"{path}: can not be read: {reason}") from error


def checked_mesh(
    path: Path,
    V: NDArray[np.float64],
    corners: NDArray[np.int64],
    sizes: NDArray[np.int64],
    where: Callable[[int], str] = "face {}".format,
) -> PolygonMesh:
    """The mesh, once it has faces, each with 3 corners or more, all of them among its vertices.

    ``where`` names a face for the message, by its line or number.
    """
    if not len(sizes):
        raise FileFormatError(f"{path}: the file has no faces; a point cloud or curve can not be mapped")
    short = np.flatnonzero(sizes < 3)
    if len(short):
        found = int(sizes[short[0]])
        raise FileFormatError(f"{path}, {where(int(short[0]))}: a face of {found} corners; give it 3 or more")
    wrong = np.flatnonzero((corners < 0) | (corners >= len(V)))
    starts = np.concatenate([np.zeros(1, np.int64), np.cumsum(sizes, dtype=np.int64)])
    if len(wrong):
        face = int(np.searchsorted(starts, wrong[0], side="right")) - 1
        raise FileFormatError(f"{path}, {where(face)}: a vertex that does not exist "
                              f"(the file has {len(V)}); {DAMAGED}")
    return PolygonMesh(np.ascontiguousarray(V), np.ascontiguousarray(corners), starts)


@contextlib.contextmanager
def foreign_parser(path: Path, what: str) -> Iterator[None]:
    """Turn whatever another library raises on a damaged file into a FileFormatError."""
    try:
        yield
    except ConformalUVError:
        raise
    except Exception as error:  # zip, zlib, struct, plyfile and trimesh between them raise nearly anything
        reason = str(error) or type(error).__name__
        raise FileFormatError(f"{path}: not a readable {what} file: {reason}; {DAMAGED}") from error


def missing_library(name: str, suffix: str) -> MissingDependencyError:
    """The error to raise when an optional library for a file format is not installed."""
    return MissingDependencyError(f"{suffix} files need the library {name}; "
                                  'install it with: pip install "conformal-uv[cli]"')
