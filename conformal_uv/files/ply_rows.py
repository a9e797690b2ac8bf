"""The rows of PLY elements as bytes.

``plyfile.PlyData.write`` goes through lists row by row and through text number by number (10 s for 200,000
vertices in text), and writes the numbers beside a list in the machine's byte order whatever the file's. Here
whole columns give the same rows, in text with the shortest decimals.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

__all__ = ["write_rows"]


def write_rows(stream: BinaryIO, ply: Any) -> None:
    """Write a ``plyfile.PlyData`` in its own text or binary format."""
    stream.write(ply.header.encode("ascii") + b"\n")
    for element in ply:
        if ply.text:
            stream.write(_text(element))
        elif any(element.data.dtype[p.name].hasobject for p in element.properties):
            stream.write(_uneven(element, ply.byte_order))
        else:
            stream.write(_even(element, ply.byte_order))


def _even(element: Any, byte_order: str) -> bytes:
    """Rows whose lists are columns: each list's length and values are fields of the record."""
    fields: list[Any] = []
    for p in element.properties:
        shape = element.data.dtype[p.name].shape
        if hasattr(p, "len_dtype"):
            length, value = p.list_dtype(byte_order)
            fields += [(p.name + "\nlen", length), (p.name, value, shape)]
        else:
            fields.append((p.name, p.dtype(byte_order)))
    rows = np.empty(element.count, fields)
    for p in element.properties:
        rows[p.name] = element.data[p.name]
        if hasattr(p, "len_dtype"):
            rows[p.name + "\nlen"] = rows.dtype[p.name].shape[0]
    return rows.tobytes()


def _uneven(element: Any, byte_order: str) -> bytes:
    """Rows with lists of different lengths."""
    columns: list[Iterable[bytes]] = []
    for p in element.properties:
        data = element.data[p.name]
        if hasattr(p, "len_dtype"):
            length, value = p.list_dtype(byte_order)
            columns.append(_cells(np.fromiter(map(len, data), np.int64, len(data)), length))
            columns.append([np.asarray(row, value).tobytes() for row in data])
        else:
            columns.append(_cells(data, p.dtype(byte_order)))
    return b"".join(chain.from_iterable(zip(*columns, strict=True)))


def _cells(column: NDArray[Any], dtype: str) -> Iterable[bytes]:
    raw, width = column.astype(dtype).tobytes(), np.dtype(dtype).itemsize
    return (raw[k : k + width] for k in range(0, len(raw), width))


def _text(element: Any) -> bytes:
    columns: list[Iterable[str]] = []
    for p in element.properties:
        data = element.data[p.name]
        if not hasattr(p, "len_dtype"):
            columns.append(_numbers(data.astype(p.val_dtype)))
        else:
            columns.append(map(str, map(len, data)))
            columns.append(" ".join(_numbers(np.asarray(row))) for row in data)
    return "".join(f"{' '.join(row).rstrip()}\n" for row in zip(*columns, strict=True)).encode("ascii")


def _numbers(values: NDArray[Any]) -> Iterable[str]:
    """The shortest texts that read back as the same numbers of their type."""
    return map(str, values if values.dtype == np.float32 else values.tolist())
