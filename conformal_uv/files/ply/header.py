"""The declarations in a PLY header, checked before a row is read so that a damaged count allocates nothing."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

from ...errors import FileFormatError
from ..checks import DAMAGED

__all__ = ["NAMES", "PlyElement", "PlyHeader", "PlyProperty", "check_counts", "read_header", "unix_text"]

BYTE_ORDER_MARK = b"\xef\xbb\xbf"
MOST_HEADER = 1 << 16

END = re.compile(rb"^end_header[ \t]*\r?\n?", re.MULTILINE)
ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
NAMES = {
    "i1": "char",
    "u1": "uchar",
    "i2": "short",
    "u2": "ushort",
    "i4": "int",
    "u4": "uint",
    "f4": "float",
    "f8": "double",
}
TYPES = {name: code for code, name in NAMES.items()} | {
    f"{kind}{8 * size}": f"{kind[0]}{size}" for kind in ("int", "uint") for size in (1, 2, 4)
}
TYPES |= {"float32": "f4", "float64": "f8"}


@dataclass(frozen=True)
class PlyProperty:
    """A property: its numbers' type as numpy writes it, and that of its length where it is a list."""

    name: str
    type: str
    length: str = ""
    line: int = -1


@dataclass
class PlyElement:
    """An element: its number of rows and its properties; ``line`` is where the header declares it."""

    name: str
    count: int
    line: int
    properties: list[PlyProperty] = field(default_factory=list)

    def property(self, name: str, *, is_list: bool = False) -> PlyProperty | None:
        """The property of this name, if it is of the kind asked for."""
        return next((p for p in self.properties if p.name == name and bool(p.length) == is_list), None)


@dataclass
class PlyHeader:
    """A header: its lines with their ends, its elements, the byte order of its rows ("" for text)."""

    lines: list[bytes]
    elements: list[PlyElement]
    order: str

    def edited(self, dropped: dict[str, list[str]], added: dict[str, list[PlyProperty]]) -> bytes:
        """The header without and with some properties by element, every other line as it was."""
        gone = {p.line for e in self.elements for p in e.properties if p.name in dropped.get(e.name, ())}
        after: dict[int, list[PlyProperty]] = {}
        for element in self.elements:
            last = max([element.line, *(p.line for p in element.properties)])
            after[last] = added.get(element.name, [])
        end = b"\r\n" if self.lines[0].endswith(b"\r\n") else b"\n"
        parts: list[bytes] = []
        for k, line in enumerate(self.lines):
            parts += [] if k in gone else [line]
            parts += [declaration(p).encode("latin-1") + end for p in after.get(k, [])]
        return b"".join(parts)


def declaration(p: PlyProperty) -> str:
    """The header line of a property."""
    kinds = f"list {NAMES[p.length]} {NAMES[p.type]}" if p.length else NAMES[p.type]
    return f"property {kinds} {p.name}"


def unix_text(data: bytes) -> bytes:
    """A text file without byte order mark and with LF at its lines' ends; a binary one as it is."""
    data = data.removeprefix(BYTE_ORDER_MARK)
    head = data[:MOST_HEADER].replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    if not head.startswith(b"ply\nformat ascii") or b"\r" not in data:
        return data
    return data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")


def read_header(path: Path, data: bytes) -> tuple[PlyHeader, int]:
    """The header, and where the rows begin.

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
    lines = data[: end.end()].splitlines(keepends=True)
    elements: list[PlyElement] = []
    order = None
    for number, line in enumerate(lines[:-1]):
        words = line.decode("latin-1").split()
        if words[:1] == ["format"] and len(words) == 3 and words[1] in ORDERS and order is None:
            order = ORDERS[words[1]]
        elif not _understood(elements, words, number):
            raise FileFormatError(
                f"{path}, line {number + 1}: a PLY header line that is not understood: "
                f"{' '.join(words)[:60]!r}; export it again"
            )
    if order is None:
        raise FileFormatError(f"{path}: the header has no line 'format ascii 1.0' or 'format binary_...'; {DAMAGED}")
    return PlyHeader(lines, elements, order), end.end()


def _understood(elements: list[PlyElement], words: list[str], number: int) -> bool:
    """Whether a line is one of a header; what it declares joins the elements."""
    match words:
        case ["element", name, count] if count.isascii() and count.isdigit():
            if any(name == e.name for e in elements):
                return False
            elements.append(PlyElement(name, int(count[:18]), number))
        case ["property", "list", length, kind, name] if elements and length in TYPES and kind in TYPES:
            return TYPES[length][0] != "f" and _add(elements[-1], PlyProperty(name, TYPES[kind], TYPES[length], number))
        case ["property", kind, name] if elements and kind in TYPES:
            return _add(elements[-1], PlyProperty(name, TYPES[kind], "", number))
        case ["ply"]:
            return number == 0
        case ["comment" | "obj_info", *_]:
            pass
        case _:
            return False
    return True


def _add(element: PlyElement, added: PlyProperty) -> bool:
    known = any(added.name == p.name for p in element.properties)
    element.properties.append(added)
    return not known


def check_counts(path: Path, header: PlyHeader, size: int) -> None:
    """Refuse a header that declares more rows than ``size`` bytes can hold."""
    for element in header.elements:
        least = sum(int((p.length or p.type)[1]) if header.order else 2 for p in element.properties)
        # the last row of a text file may lack its newline
        if element.count * max(least, 1) > size + 1:
            raise FileFormatError(
                f"{path}: {element.count} rows of {element.name!r} are declared, more than "
                f"{size} bytes can hold; {DAMAGED}"
            )
