"""One surface in a file that every rank reads and writes its rows of."""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from ..errors import FileFormatError
from ..files.npz_rows import ArchiveLayout, joined_crc, mesh_rows, write_rows
from .ranks import Ranks

__all__ = ["read_slice", "write_slices"]


def read_slice(path: str | os.PathLike[str], comm: Any = None) -> tuple[NDArray[Any], NDArray[Any]]:
    """This process's rows of V and F from an uncompressed NPZ archive, or a folder with V.npy and F.npy.

    Rows are shared out evenly, in order.

    Raises
    ------
    FileFormatError
        On all processes.
    """
    ranks = Ranks(comm)
    with ranks.agreed():
        found = [rows.read(*_share(ranks, rows.rows)) for rows in mesh_rows(Path(path))]
    return found[0], found[1]


def write_slices(path: str | os.PathLike[str], comm: Any = None, **arrays: NDArray[Any]) -> None:
    """Write arrays, the rows of the processes one after the other's, into an uncompressed NPZ archive.

    The file takes its place in one step, after all processes have written.

    Parameters
    ----------
    arrays : (k, c) arrays
        Under the names that they are to have; each process passes its own rows.

    Raises
    ------
    FileFormatError
        On all processes; the file is then as it was.
    """
    ranks = Ranks(comm)
    target = Path(os.path.realpath(path))
    temporary = Path(ranks.comm.bcast(str(target.with_name(f".{secrets.token_hex(8)}.tmp")), root=0))
    counts = {name: ranks.each(len(rows)) for name, rows in arrays.items()}
    layout = ArchiveLayout({name: (sum(counts[name]), rows.shape[1], rows.dtype) for name, rows in arrays.items()})
    try:
        with ranks.agreed(), _told(path):
            if ranks.rank == 0:
                with open(temporary, "xb") as stream:
                    stream.truncate(layout.end)
        sums: dict[str, list[tuple[int, int]]] = {}
        for name, rows in arrays.items():
            crc = 0
            with ranks.agreed(), _told(path):
                crc = write_rows(layout.rows(temporary, name), sum(counts[name][: ranks.rank]), rows)
            sums[name] = ranks.each((crc, rows.nbytes))
        with ranks.agreed(), _told(path):
            if ranks.rank == 0:
                with open(temporary, "r+b") as stream:
                    layout.write_frame(stream, {name: _joined(parts) for name, parts in sums.items()})
                    stream.flush()
                    os.fsync(stream.fileno())
                with suppress(FileNotFoundError):
                    os.chmod(temporary, os.stat(target).st_mode & 0o7777)
                os.replace(temporary, target)
    finally:
        if ranks.rank == 0:
            with suppress(OSError):
                os.unlink(temporary)


def _share(ranks: Ranks, count: int) -> tuple[int, int]:
    return count * ranks.rank // ranks.size, count * (ranks.rank + 1) // ranks.size


def _joined(parts: list[tuple[int, int]]) -> int:
    crc = 0
    for other, length in parts:
        crc = joined_crc(crc, other, length)
    return crc


@contextmanager
def _told(path: str | os.PathLike[str]) -> Iterator[None]:
    """Turns an OSError into one of ours."""
    try:
        yield
    except OSError as error:
        raise FileFormatError(
            f"{path}: can not be written: {error.strerror or error}; the file is left as it was"
        ) from error
