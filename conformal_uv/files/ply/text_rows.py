"""Rows of a text PLY element: one line each, read a block of lines at a time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import FileFormatError
from ..spans import spans
from ..text_lines import BLANK, NEWLINE
from ..text_numbers import float_numbers, whole_numbers
from .header import PlyElement, PlyProperty
from .rows import Ints, damaged_row, kept_type

__all__ = ["TextBlock", "TextRows"]

BLOCK = 1 << 19  # bytes looked at together
MOST_WHOLE = 2.0**53


@dataclass(frozen=True, eq=False)
class TextBlock:
    """Some rows: their text, where each word begins in it, and the first word of each row (and one behind)."""

    row: int
    begin: int
    text: bytes
    words: Ints
    first: Ints


class TextRows:
    """Rows that stand in lines of their own."""

    def __init__(self, path: Path, data: bytes, begin: int, element: PlyElement) -> None:
        self.path, self.data, self.begin, self.element = path, data, begin, element
        self.end = begin
        rows = 0
        for start, _, ends in self._blocks():
            rows, self.end = rows + len(ends), start + int(ends[-1]) + 1
        if rows < element.count:
            raise damaged_row(path, element, rows, "the file ends before it")

    def _blocks(self) -> Iterator[tuple[int, bytes, Ints]]:
        """Whole lines: where they begin, their text (always ending a line), and where each ends in it."""
        left, start, size = self.element.count, self.begin, BLOCK
        while left and start < len(self.data):
            text = self.data[start : start + size]
            if start + size >= len(self.data) and not text.endswith(b"\n"):
                text += b"\n"
            ends = np.flatnonzero(np.frombuffer(text, np.uint8) == NEWLINE)[:left]
            if not len(ends):
                size *= 2
                continue
            stop = int(ends[-1]) + 1
            yield start, text[:stop], ends
            left, start, size = left - len(ends), start + stop, BLOCK

    def blocks(self) -> Iterator[TextBlock]:
        """The rows by blocks, their words found."""
        row = 0
        for begin, text, ends in self._blocks():
            inked = np.frombuffer(text, np.uint8) > BLANK
            words = np.flatnonzero(inked[1:] & ~inked[:-1]) + 1
            words = np.concatenate([np.zeros(int(inked[0]), np.int64), words])
            first = np.concatenate([np.zeros(1, np.int64), np.searchsorted(words, ends)])
            yield TextBlock(row, begin, text, words, first)
            row += len(ends)

    def columns(self, wanted: list[PlyProperty]) -> list[NDArray[Any]]:
        """Scalar properties."""
        found: list[NDArray[Any]] = [np.empty(self.element.count, kept_type(p)) for p in wanted]
        for block in self.blocks():
            values, places, _ = self.layout(block)
            for p, column in zip(wanted, found, strict=True):
                part = self._typed(block, p, values[places[p.name]])
                column[block.row : block.row + len(part)] = part
        return found

    def lists(self, wanted: list[PlyProperty]) -> list[tuple[NDArray[Any], Ints]]:
        """List properties."""
        parts: list[list[NDArray[Any]]] = [[np.empty(0, kept_type(p))] for p in wanted]
        lengths = [np.empty(self.element.count, np.int64) for _ in wanted]
        for block in self.blocks():
            values, places, counts = self.layout(block)
            rows = slice(block.row, block.row + len(block.first) - 1)
            for p, part, length in zip(wanted, parts, lengths, strict=True):
                length[rows] = counts[p.name]
                taken = _taken(values, places[p.name] + 1, counts[p.name], block.first)
                part.append(self._typed(block, p, taken))
        return [(np.concatenate(part), length) for part, length in zip(parts, lengths, strict=True)]

    def layout(self, block: TextBlock) -> tuple[NDArray[Any], dict[str, Ints], dict[str, Ints]]:
        """A block's numbers, the first of each property by row (of a list its length), and the lists' lengths."""
        whole = all(p.type[0] != "f" for p in self.element.properties)
        values = (whole_numbers if whole else float_numbers)(block.text, len(block.words))
        if values is None:
            raise self._refused(block, self._no_number(block), "a word that is not a number")
        at, last = block.first[:-1], block.first[1:]
        places, lengths = {}, {}
        for p in self.element.properties:
            places[p.name] = at
            self._check(block, at >= last, "numbers are missing")
            if p.length:
                length = values[at]
                with np.errstate(invalid="ignore"):
                    sound = (length >= 0) & (length < last - at) & (length % 1 == 0)
                self._check(block, ~sound, "a list of another length")
                lengths[p.name] = length.astype(np.int64)
                at = at + lengths[p.name]
            at = at + 1
        self._check(block, at != last, "more numbers than its properties")
        return values, places, lengths

    def _typed(self, block: TextBlock, p: PlyProperty, values: NDArray[Any]) -> NDArray[Any]:
        """Numbers in the precision that the header declares."""
        kind = kept_type(p)
        if kind == np.int64 and values.dtype != np.int64:
            with np.errstate(invalid="ignore"):
                sound = (np.abs(values) < MOST_WHOLE) & (values % 1 == 0)
            if not sound.all():
                raise self._refused(block, 0, f"a number of {p.name!r} here or below that is not a whole number")
        with np.errstate(over="ignore"):
            return values.astype(kind, copy=False)

    def _check(self, block: TextBlock, wrong: NDArray[np.bool_], what: str) -> None:
        if wrong.any():
            raise self._refused(block, int(np.argmax(wrong)), f"{what}, as the header declares {self.element.name!r}")

    def _no_number(self, block: TextBlock) -> int:
        """The row of a block with a word that is no number."""
        lines = block.text.split(b"\n")
        counts = np.diff(block.first).tolist()
        parse = whole_numbers if all(p.type[0] != "f" for p in self.element.properties) else float_numbers
        return next(k for k, n in enumerate(counts) if parse(lines[k], n) is None)

    def _refused(self, block: TextBlock, row: int, what: str) -> FileFormatError:
        lines = block.text.split(b"\n")
        number = self.data.count(b"\n", 0, block.begin) + row + 1
        quoted = lines[row].strip()[:60].decode("latin-1")
        return FileFormatError(
            f"{self.path}, line {number}: {what}: {quoted!r}; correct the line or export the file again"
        )


def _taken(values: NDArray[Any], starts: Ints, lengths: Ints, first: Ints) -> NDArray[Any]:
    """So many values from each start on; where all rows are alike, a part of every row."""
    length, width = int(lengths[0]), int(first[1])
    if width * len(lengths) == len(values) and (lengths == length).all() and (starts == starts[0] + first[:-1]).all():
        offset = int(starts[0])
        return values.reshape(len(lengths), width)[:, offset : offset + length].reshape(-1)
    return values[spans(starts, lengths)]
