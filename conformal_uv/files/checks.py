"""What every reader checks, and the form of its refusals."""

from __future__ import annotations

import contextlib
import gzip
import io
import logging
import sys
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import ConformalUVError, FileFormatError, MissingDependencyError
from ..mesh.polygons import PolygonMesh

__all__ = ["ALWAYS_TAKEN", "DAMAGED", "MOST_PACKED", "checked_mesh", "file_bytes", "foreign_parser", "missing_library"]

MOST_PACKED, ALWAYS_TAKEN = 100, 1 << 24
"""Coordinates and indices of real meshes are packed into a tenth, blank text into a fiftieth: what claims to be more
than a hundred times its own size, and more than 16 MB, is no mesh."""

DAMAGED = "the file is damaged or cut short; export it again"


def file_bytes(path: Path) -> bytes:
    """The file's content, unpacked if it ends with .gz; ``-`` is standard input. Every failure is a FileFormatError."""
    try:
        data = sys.stdin.buffer.read() if str(path) == "-" else path.read_bytes()
    except FileNotFoundError:
        raise FileFormatError(f"{path}: no such file; check the name and the folder") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise FileFormatError(f"{path}: can not be read: {reason}") from error
    return _unpacked(path, data) if path.suffix.lower() == ".gz" else data


def _unpacked(path: Path, data: bytes) -> bytes:
    """What gzip packed, as long as it is not more than a mesh can be packed."""
    most = max(MOST_PACKED * len(data), ALWAYS_TAKEN)
    parts, size = [], 0
    try:
        with gzip.open(io.BytesIO(data)) as stream:
            while part := stream.read(1 << 22):
                parts.append(part)
                size += len(part)
                if size > most:
                    raise FileFormatError(f"{path}: {len(data)} bytes hold more than {most}; this is no packed mesh")
    except (OSError, EOFError, zlib.error) as error:
        raise FileFormatError(f"{path}: not a readable gzip file: {error}; {DAMAGED}") from error
    return b"".join(parts)


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
    if sizes.min() < 3:
        short = int(np.argmax(sizes < 3))
        raise FileFormatError(f"{path}, {where(short)}: a face of {int(sizes[short])} corners; give it 3 or more")
    starts = np.zeros(len(sizes) + 1, np.int64)
    np.cumsum(sizes, out=starts[1:])
    if corners.min() < 0 or corners.max() >= len(V):
        wrong = int(np.argmax((corners < 0) | (corners >= len(V))))
        face = int(np.searchsorted(starts, wrong, side="right")) - 1
        raise FileFormatError(f"{path}, {where(face)}: a vertex that does not exist (the file has {len(V)}); {DAMAGED}")
    return PolygonMesh(np.ascontiguousarray(V), np.ascontiguousarray(corners), starts)


@contextlib.contextmanager
def foreign_parser(path: Path, what: str, library: str = "") -> Iterator[None]:
    """Turn whatever another library raises on a damaged file into a FileFormatError, and keep it from logging."""
    log = logging.getLogger(library) if library else None
    level = log.level if log is not None else 0
    try:
        if log is not None:
            log.setLevel(logging.CRITICAL + 1)
        yield
    except ConformalUVError:
        raise
    except Exception as error:  # zip, zlib, struct, trimesh and meshio between them raise nearly anything
        reason = str(error) or type(error).__name__
        raise FileFormatError(f"{path}: not a readable {what} file: {reason}; {DAMAGED}") from error
    finally:
        if log is not None:
            log.setLevel(level)


def missing_library(name: str, suffix: str) -> MissingDependencyError:
    """The error to raise when an optional library for a file format is not installed."""
    return MissingDependencyError(
        f'{suffix} files need the library {name}; install it with: pip install "conformal-uv[cli]"'
    )
