"""Where rows are kept: a line of JSON each as it comes, and tables of all in the end."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Iterable
from dataclasses import fields
from pathlib import Path
from typing import IO

from ..errors import FileFormatError
from ..files import replaced_file
from .row import BatchRow

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

__all__ = ["LINES", "RowLog", "read_rows", "write_tables"]

LINES, TABLE, PARQUET = "rows.jsonl", "rows.csv", "rows.parquet"
NAMES = tuple(one.name for one in fields(BatchRow) if one.name != "kept")


def read_rows(folder: Path) -> dict[str, BatchRow]:
    """The last row of each output that earlier runs have left; a line that was cut off is passed over."""
    found: dict[str, BatchRow] = {}
    try:
        text = (folder / LINES).read_text(encoding="utf-8")
    except FileNotFoundError:
        return found
    except (OSError, ValueError) as error:
        raise FileFormatError(f"{folder / LINES}: can not be read ({error}); remove it to begin anew.") from error
    for line in text.splitlines():
        try:
            row = BatchRow.restored(json.loads(line))
        except (ValueError, KeyError, TypeError):
            continue
        found.pop(row.output, None)
        found[row.output] = row
    return found


class RowLog:
    """The file of lines, to which rows are added; each is on its way to the disk when `add` returns.

    Raises
    ------
    FileFormatError
        It can not be written, or another run is at it.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / LINES
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self._stream: IO[bytes] = open(self._path, "ab+", buffering=0)  # noqa: SIM115
            if not _locked(self._stream):
                self._stream.close()
                raise FileFormatError(
                    f"{self._path}: another run is writing it; wait for its end, or choose another folder."
                )
            end = self._stream.seek(0, os.SEEK_END)
            if end and self._last() != b"\n":  # an earlier run was cut off
                self._stream.write(b"\n")
        except OSError as error:
            raise FileFormatError(f"{self._path}: can not be written: {error.strerror or error}") from error

    def _last(self) -> bytes:
        self._stream.seek(-1, os.SEEK_END)
        return self._stream.read(1)

    def add(self, row: BatchRow) -> None:
        """Add a line."""
        try:
            self._stream.write(json.dumps(row.stored(), ensure_ascii=True).encode() + b"\n")
        except OSError as error:
            raise FileFormatError(f"{self._path}: can not be written: {error.strerror or error}") from error

    def close(self) -> None:
        """Close the file."""
        self._stream.close()


def _locked(stream: IO[bytes]) -> bool:
    """Whether the file is ours until it is closed; where files can not be locked, nobody asks."""
    if fcntl is None:
        return True
    try:
        fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:  # a file system without locks
        return True
    return True


def write_tables(folder: Path, rows: Iterable[BatchRow]) -> None:
    """The rows as CSV, and as Parquet where pyarrow is installed, each replaced in one step."""
    stored = [row.stored() for row in rows]
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, NAMES)
    writer.writeheader()
    writer.writerows(stored)
    with replaced_file(folder / TABLE) as out:
        out.write(text.getvalue().encode())
    try:
        import pyarrow as pa
        from pyarrow import parquet
    except ImportError:  # or one that does not go with this numpy
        return
    kinds = {"int": pa.int64(), "float": pa.float64()}
    schema = pa.schema([(name, kinds.get(_kind(name), pa.string())) for name in NAMES])
    plain = [{name: str(value) if name == "status" else value for name, value in row.items()} for row in stored]
    with replaced_file(folder / PARQUET) as out:
        parquet.write_table(pa.Table.from_pylist(plain, schema=schema), out)


def _kind(name: str) -> str:
    """The type of a field, as it is written in the class."""
    return str(BatchRow.__annotations__[name]).split(" ")[0]
