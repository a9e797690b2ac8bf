"""Where the lists of a binary PLY element stand: each place depends on the lengths before it."""

from __future__ import annotations

import contextlib
import struct
from collections.abc import Iterator

from .header import PlyElement, PlyProperty

__all__ = ["first_cut", "first_lengths", "list_places", "lists_of"]

CODES = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I"}


def lists_of(element: PlyElement) -> list[PlyProperty]:
    return [p for p in element.properties if p.length]


def first_lengths(data: bytes, begin: int, element: PlyElement, order: str) -> list[int] | None:
    """The lengths of the first row's lists, if it is all there."""
    lengths, at = [], begin
    for p in element.properties if element.count else []:
        count = 1
        if p.length:
            if at + int(p.length[1]) > len(data):
                return None
            (count,) = struct.unpack_from(order + CODES[p.length], data, at)
            at += int(p.length[1])
            lengths.append(count)
        at += count * int(p.type[1])
        if count < 0 or at > len(data):
            return None
    return lengths if element.count else [0] * len(lists_of(element))


def list_places(data: bytes, begin: int, element: PlyElement, order: str) -> Iterator[int]:
    """Where the length of each list stands, row after row; struct.error or IndexError where the file ends."""
    steps: list[tuple[int, struct.Struct, int, int]] = []
    skip = 0
    for p in element.properties:
        if p.length:
            steps.append((skip, struct.Struct(order + CODES[p.length]), int(p.length[1]), int(p.type[1])))
            skip = 0
        else:
            skip += int(p.type[1])
    if len(steps) == 1 and steps[0][1].format.endswith("B"):
        yield from _byte_places(data, begin + steps[0][0], element.count, steps[0][3], 1 + skip + steps[0][0])
        return
    at = begin
    for _ in range(element.count):
        for before, length, width, size in steps:
            at += before
            yield at
            at += width + size * max(length.unpack_from(data, at)[0], 0)
        at += skip


def _byte_places(data: bytes, at: int, count: int, size: int, fixed: int) -> Iterator[int]:
    """The same for rows of one list that a byte counts, the form of nearly every file."""
    step = [fixed + size * length for length in range(256)]
    for _ in range(count):
        yield at
        at += step[data[at]]


def first_cut(data: bytes, begin: int, element: PlyElement, order: str) -> int:
    """The first row that the file has not whole."""
    lists = len(lists_of(element))
    if not lists:
        return (len(data) - begin) // sum(int(p.type[1]) for p in element.properties)
    found = 0
    with contextlib.suppress(struct.error, IndexError):
        for place in list_places(data, begin, element, order):
            found += place < len(data)
    return min((found - 1) // lists, element.count - 1)
