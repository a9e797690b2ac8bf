"""The triangles of a text STL file, a block of lines at a time."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import FileFormatError
from .checks import DAMAGED
from .text_lines import BLANK, NEWLINE
from .text_numbers import float_numbers

__all__ = ["text_corners"]

BLOCK = 1 << 19  # bytes looked at together
KEYWORDS = {
    b"solid": b"s",
    b"facet": b"f",
    b"vertex": b"v",
    b"endfacet": b"e",
    b"endsolid": b"t",
}
FACET = b"fvvve"
WORD = np.dtype("<u8")
LOWER_CASE = np.uint64(0x2020202020202020)
ANYWHERE = re.compile(rb"\b(endsolid|endfacet|endloop|vertex|outer|facet|solid)\b", re.IGNORECASE)


def text_corners(path: Path, data: bytes) -> NDArray[np.float64]:
    """The corners one after the other, (3m, 3).

    Raises
    ------
    FileFormatError
        There are no facets, a solid has no end, a facet has other than three corners, or a corner other than three
        numbers.
    """
    if b"\n" not in data:
        data = data.replace(b"\r", b"\n")
    lines, soup = _scanned(path, data)
    if _whole(lines):
        return soup
    with contextlib.suppress(FileFormatError):
        again, soup = _scanned(path, ANYWHERE.sub(rb"\n\1", data))  # keywords that stand behind each other on a line
        if _whole(again):
            return soup
    sound = re.match(rb"(?:s|t|%b)*+" % FACET, lines)
    facet = lines.count(b"f", 0, sound.end() if sound else 0)
    raise FileFormatError(
        f"{path}: not a text STL file of whole solids, at facet {facet} of {lines.count(b'f')}: a facet has three "
        f"corners and stands between solid and endsolid; {DAMAGED}"
    )


def _whole(lines: bytes) -> bool:
    """Whether these are solids of facets, at least one."""
    rest = lines.replace(FACET, b"")
    return FACET in lines and rest == b"st" * (len(rest) // 2) and lines[:1] == b"s" and b"tf" not in lines


def _scanned(path: Path, data: bytes) -> tuple[bytes, NDArray[np.float64]]:
    """A letter for each line that begins with a keyword, and the numbers of those that begin with vertex."""
    letters, numbers = [], [np.empty((0, 3))]
    facets = 0
    for text in _blocks(data):
        letter, first, counts, words, ends = _keywords(text)
        is_vertex = letter == ord("v")
        starts, stops = words[first[is_vertex]] + len(b"vertex"), ends[is_vertex]
        marks = np.zeros(len(text), np.int8)
        marks[starts] = 1
        marks[stops] = -1
        wanted = text[np.cumsum(marks, dtype=np.int8).view(bool)]
        found = None if (counts[is_vertex] != 4).any() else float_numbers(wanted.tobytes(), 3 * len(starts))
        if found is None:
            raise FileFormatError(f"{path}: {_bad_vertex(text, starts, stops)}: three numbers expected; {DAMAGED}")
        numbers.append(found.reshape(-1, 3))
        letters.append(letter[letter > 0].tobytes())
        facets += int(np.count_nonzero(letter == ord("f")))
    return b"".join(letters), np.concatenate(numbers)


def _blocks(data: bytes) -> Iterator[NDArray[np.uint8]]:
    """Whole lines, each with its end, and eight blanks behind."""
    begin = 0
    while begin < len(data):
        end = data.rfind(b"\n", begin, begin + BLOCK) + 1 or data.find(b"\n", begin + BLOCK) + 1 or len(data)
        yield np.frombuffer(data[begin:end] + b"\n" + b" " * WORD.itemsize, np.uint8)
        begin = end


def _keywords(text: NDArray[np.uint8]) -> tuple[NDArray[Any], ...]:
    """For each line with words: its keyword's letter (0 for another word), first word, number of words; where every
    word begins; where the lines end."""
    inked = text > BLANK
    words = np.flatnonzero(inked[1:] & ~inked[:-1]) + 1
    words = np.concatenate([np.zeros(int(inked[0]), np.int64), words])
    ends = np.flatnonzero(text == NEWLINE)
    behind = np.searchsorted(words, ends)
    counts = np.diff(behind, prepend=0)
    has = counts > 0
    first, counts, ends = (behind - counts)[has], counts[has], ends[has]
    at = words[first]
    heads = np.ndarray(len(text) - 7, WORD, text, strides=(1,))[at] | LOWER_CASE
    letter = np.zeros(len(at), np.uint8)
    for word, sign in KEYWORDS.items():
        mask = np.uint64((1 << 8 * len(word)) - 1)
        same = (heads & mask) == np.uint64(int.from_bytes(word, "little"))
        letter[same & (text[at + len(word)] <= BLANK)] = sign[0]
    return letter, first, counts, words, ends


def _bad_vertex(text: NDArray[np.uint8], starts: NDArray[np.int64], stops: NDArray[np.int64]) -> str:
    """The line of a vertex that has not three numbers."""
    for begin, end in zip(starts.tolist(), stops.tolist(), strict=True):
        line = text[begin:end].tobytes()
        if len(line.split()) != 3 or float_numbers(line, 3) is None:
            return f"vertex {line.strip()[:60].decode('latin-1')!r}"
    return "a vertex"
