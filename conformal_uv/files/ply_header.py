"""The declarations in a PLY header, read before plyfile so that a damaged count allocates nothing."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

from conformal_uv.errors import FileFormatError
from conformal_uv.files.checks import DAMAGED

__all__ = ["PlyElementHeader", "check_counts", "read_ply_header", "unix_text"]

BYTE_ORDER_MARK = b"\xef\xbb\xbf"
MOST_HEADER = 1 << 16

END = re.compile(rb"^end_header[ \t]*\r?\n?", re.MULTILINE)
BYTES = {
    "char": 1,
    "uchar": 1,
    "int8": 1,
    "uint8": 1,
    "short": 2,
    "ushort": 2,
    "int16": 2,
    "uint16": 2,
    "int": 4,
    "uint": 4,
    "int32": 4,
    "uint32": 4,
    "float": 4,
    "float32": 4,
    "double": 8,
    "float64": 8,
}


@dataclass
class PlyElementHeader:
    """An element: its count, its list properties, and the least bytes that one of its rows takes."""

    name: str
    count: int
    lists: list[str] = field(default_factory=list)
    least_bytes: int = 0


def unix_text(data: bytes) -> bytes:
    """A text file without byte order mark and with LF at its lines' ends; a binary one as it is."""
    data = data.removeprefix(BYTE_ORDER_MARK)
    head = data[:MOST_HEADER].replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    if not head.startswith(b"ply\nformat ascii") or b"\r" not in data:
        return data
    return data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")


def read_ply_header(path: Path, data: bytes) -> tuple[list[PlyElementHeader], bool, int]:
    """The elements, whether the file is text, and where its rows begin.

    Raises
    ------
    FileFormatError
        It is not a PLY file, or a line of the header is not understood.
    """
    end = END.search(data)
    if not data.startswith(b"ply") or end is None:
        raise FileFormatError(
            f"{path}: not a PLY file: it must begin with the line 'ply' and have a line 'end_header'; export it again"
        )
    elements: list[PlyElementHeader] = []
    text = False
    for number, line in enumerate(data[: end.start()].split(b"\n"), start=1):
        words = line.decode("latin-1").split()
        if words[:1] == ["format"]:
            text = words[1:2] == ["ascii"]
        elif words[:1] == ["element"] and len(words) == 3 and words[2].isascii() and words[2].isdigit():
            elements.append(PlyElementHeader(words[1], int(words[2][:18])))
        elif words[:1] in (["element"], ["property"]):
            if not elements or not _add_property(elements[-1], words, text):
                raise FileFormatError(
                    f"{path}, line {number}: a PLY header line that is not understood: "
                    f"{' '.join(words)[:60]!r}; export it again"
                )
    return elements, text, end.end()


def _add_property(element: PlyElementHeader, words: list[str], text: bool) -> bool:
    if len(words) == 5 and words[:2] == ["property", "list"] and words[2] in BYTES and words[3] in BYTES:
        element.lists.append(words[4])
    elif len(words) != 3 or words[0] != "property" or words[1] not in BYTES:
        return False
    element.least_bytes += 2 if text else BYTES[words[-3] if len(words) == 5 else words[1]]
    return True


def check_counts(path: Path, elements: list[PlyElementHeader], size: int) -> None:
    """Refuse a header that declares more rows than ``size`` bytes can hold."""
    for element in elements:
        # the last row of a text file may lack its newline
        if element.count * max(element.least_bytes, 1) > size + 1:
            raise FileFormatError(
                f"{path}: {element.count} rows of {element.name!r} are declared, more than "
                f"{size} bytes can hold; {DAMAGED}"
            )
