"""Rows of the arrays of an uncompressed NPZ archive, or of .npy files, read and written where they stand.

Many processes read and write one file, each its own rows, and none the whole.
"""

from __future__ import annotations

import io
import os
import struct
import zipfile
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import FileFormatError
from .checks import DAMAGED

__all__ = ["ArrayRows", "ArchiveLayout", "joined_crc", "mesh_rows", "write_rows"]

LOCAL = struct.Struct("<4s5H3I2H")
CENTRAL = struct.Struct("<4s6H3I5H2I")
END64, LOCATOR64, END = struct.Struct("<4sQ2H2I4Q"), struct.Struct("<4sIQI"), struct.Struct("<4s4H2IH")
WIDE, VERSION = 0xFFFFFFFF, 45  # sizes stand in the ZIP64 field, which that version of the format brought
FIRST_DATE = (1 << 5) | 1  # 1 January 1980
POLYNOMIAL = 0xEDB88320


@dataclass(frozen=True)
class ArrayRows:
    """An array (rows, columns) in C order somewhere in a file."""

    path: Path
    offset: int
    rows: int
    columns: int
    dtype: np.dtype[Any]

    def read(self, first: int, last: int) -> NDArray[Any]:
        """Rows first .. last - 1.

        Raises
        ------
        FileFormatError
            The file ends before them.
        """
        step = self.columns * self.dtype.itemsize
        count = (last - first) * self.columns
        try:
            found = np.fromfile(self.path, self.dtype, count, offset=self.offset + first * step)
        except OSError as error:
            raise FileFormatError(f"{self.path}: can not be read: {error.strerror or error}") from error
        if len(found) < count:
            raise FileFormatError(f"{self.path}: ends before row {last} of {self.rows}; {DAMAGED}")
        return found.reshape(-1, self.columns)


def mesh_rows(path: Path) -> tuple[ArrayRows, ArrayRows]:
    """Where V and F stand: in an NPZ archive, or in a folder with V.npy and F.npy.

    Raises
    ------
    FileFormatError
    """
    if path.is_dir():
        return _checked(path / "V.npy", "V", "f"), _checked(path / "F.npy", "F", "iu")
    return _checked(path, "V", "f"), _checked(path, "F", "iu")


def _checked(path: Path, name: str, kinds: str) -> ArrayRows:
    try:
        with open(path, "rb") as stream:
            start = 0 if path.suffix.lower() == ".npy" else _member(path, stream, name)
            stream.seek(start)
            version = np.lib.format.read_magic(stream)
            read = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
            shape, by_columns, dtype = read(stream)
            offset = stream.tell()
    except OSError as error:
        raise FileFormatError(f"{path}: can not be read: {error.strerror or error}") from error
    except (ValueError, EOFError, zipfile.BadZipFile) as error:
        raise FileFormatError(f"{path}: {name!r}: {error}; {DAMAGED}") from error
    if len(shape) != 2 or shape[1] != 3 or dtype.kind not in kinds or (by_columns and shape[0] > 1):
        raise FileFormatError(
            f"{path}: {name!r} has the shape {shape} and type {dtype}"
            f"{' in Fortran order' if by_columns else ''}; save V (n, 3) as floats and F (m, 3) as integers, in C order"
        )
    return ArrayRows(path, offset, shape[0], shape[1], dtype)


def _member(path: Path, stream: io.BufferedReader, name: str) -> int:
    """Where an archive's array begins."""
    with zipfile.ZipFile(stream) as archive:
        try:
            info = archive.getinfo(f"{name}.npy")
        except KeyError as error:
            raise FileFormatError(
                f"{path}: no array {name!r}; save V and F with numpy.savez (found: {', '.join(archive.namelist())})"
            ) from error
    if info.compress_type != zipfile.ZIP_STORED:
        raise FileFormatError(
            f"{path}: {name!r} is compressed, so that no process can read its rows alone; save it with numpy.savez"
        )
    stream.seek(info.header_offset)
    head = LOCAL.unpack(stream.read(LOCAL.size))
    return info.header_offset + LOCAL.size + head[-2] + head[-1]


class ArchiveLayout:
    """Where everything stands in an NPZ archive that is yet to be written.

    Parameters
    ----------
    arrays : mapping of name to (rows, columns, dtype)
    """

    def __init__(self, arrays: dict[str, tuple[int, int, np.dtype[Any]]]) -> None:
        self._arrays = arrays
        self._heads: dict[str, bytes] = {}
        self._starts: dict[str, int] = {}
        place = 0
        for name, (rows, columns, dtype) in arrays.items():
            head = io.BytesIO()
            told = {"descr": np.lib.format.dtype_to_descr(dtype), "fortran_order": False, "shape": (rows, columns)}
            np.lib.format.write_array_header_1_0(head, told)
            self._heads[name], self._starts[name] = head.getvalue(), place
            place += LOCAL.size + len(f"{name}.npy") + 20 + self._size(name)
        self.end = place

    def rows(self, path: Path, name: str) -> ArrayRows:
        """Where an array's numbers stand."""
        rows, columns, dtype = self._arrays[name]
        at = self._starts[name] + LOCAL.size + len(f"{name}.npy") + 20 + len(self._heads[name])
        return ArrayRows(path, at, rows, columns, dtype)

    def write_frame(self, stream: io.BufferedRandom, sums: dict[str, int]) -> None:
        """Everything but the numbers, given the CRC-32 of each array's bytes."""
        central = []
        for name, start in self._starts.items():
            head, size, file = self._heads[name], self._size(name), f"{name}.npy".encode()
            crc = joined_crc(zlib.crc32(head), sums[name], size - len(head))
            fields = (0, 0, 0, FIRST_DATE, crc, WIDE, WIDE, len(file))
            stream.seek(start)
            stream.write(LOCAL.pack(b"PK\x03\x04", VERSION, *fields, 20) + file)
            stream.write(struct.pack("<2H2Q", 1, 16, size, size) + head)
            wide = struct.pack("<2H3Q", 1, 24, size, size, start)
            central.append(CENTRAL.pack(b"PK\x01\x02", VERSION, VERSION, *fields, len(wide), 0, 0, 0, 0, WIDE))
            central.append(file + wide)
        listed, count = b"".join(central), len(self._starts)
        stream.seek(self.end)
        stream.write(listed)
        stream.write(END64.pack(b"PK\x06\x06", 44, VERSION, VERSION, 0, 0, count, count, len(listed), self.end))
        stream.write(LOCATOR64.pack(b"PK\x06\x07", 0, self.end + len(listed), 1))
        stream.write(END.pack(b"PK\x05\x06", 0, 0, count, count, len(listed), WIDE, 0))

    def _size(self, name: str) -> int:
        rows, columns, dtype = self._arrays[name]
        return len(self._heads[name]) + rows * columns * dtype.itemsize


def write_rows(place: ArrayRows, first: int, values: NDArray[Any]) -> int:
    """Write rows from `first` on into a file that is there; their CRC-32."""
    data = np.ascontiguousarray(values, dtype=place.dtype)
    with open(place.path, "r+b") as stream:
        stream.seek(place.offset + first * place.columns * place.dtype.itemsize)
        stream.write(data.data if data.size else b"")
        stream.flush()
        os.fsync(stream.fileno())
    return zlib.crc32(data.data if data.size else b"")


def joined_crc(one: int, other: int, length: int) -> int:
    """The CRC-32 of two stretches of bytes after each other from theirs, the second being so long.

    M. Adler's crc32_combine: zero bytes act on a CRC as a matrix over GF(2), which is squared for each bit of the
    length.
    """
    shift = np.concatenate(([POLYNOMIAL], 1 << np.arange(31, dtype=np.int64)))  # one zero bit
    for _ in range(3):
        shift = _applied(shift, shift)
    while length:
        if length & 1:
            one = int(_applied(shift, np.array([one]))[0])
        shift = _applied(shift, shift)
        length >>= 1
    return one ^ other


def _applied(matrix: NDArray[np.int64], vectors: NDArray[np.int64]) -> NDArray[np.int64]:
    bits = (vectors[:, None] >> np.arange(32)) & 1
    return np.bitwise_xor.reduce(np.where(bits == 1, matrix, 0), axis=1)
