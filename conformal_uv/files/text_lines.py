"""A text mesh file as lines and tokens, found for the whole file at once."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from conformal_uv.errors import FileFormatError

__all__ = ["TextLines", "spans"]

NEWLINE, RETURN, BLANK, HASH, BACKSLASH = b"\n\r #\\"


def spans(starts: NDArray[np.int64], lengths: NDArray[np.int64]) -> NDArray[np.int64]:
    """The indices start, start + 1, ... of every span, one span after the other."""
    offsets = np.cumsum(lengths) - lengths
    return np.repeat(starts - offsets, lengths) + np.arange(int(lengths.sum()))


class TextLines:
    """Lines of a text file of numbers, with comments (``#``) and line continuations (``\\``) blanked.

    Attributes
    ----------
    data : bytes
        The file.
    text : (N + 1,) uint8
        The same, byte for byte at the same place, with blanks and newlines as its only white space.
    starts, ends : (L,) int64
        Each line's span, its newline included; continued lines are one line.
    tokens : (t,) int64
        Where each word begins.
    first, counts : (L,) int64
        Each line's first word (an index into ``tokens``) and number of words.
    """

    def __init__(self, path: Path, data: bytes) -> None:
        self.path = path
        self.data = data
        self.text = text = np.append(np.frombuffer(data, np.uint8), np.uint8(NEWLINE))
        if b"\n" not in data:
            text[text == RETURN] = NEWLINE
        np.putmask(text, (text < BLANK) & (text != NEWLINE), BLANK)
        if b"#" in data:
            self._blank_comments()
        if b"\\" in data:
            self._join_continued()
        self.ends = np.flatnonzero(text == NEWLINE) + 1
        self.starts = np.concatenate([np.zeros(1, np.int64), self.ends])[:-1]
        inked = text > BLANK
        begins = inked.copy()
        begins[1:] &= ~inked[:-1]
        self.tokens = np.flatnonzero(begins)
        self.first = np.searchsorted(self.tokens, self.starts)
        self.counts = np.diff(np.append(self.first, len(self.tokens)))

    def _blank_comments(self) -> None:
        text = self.text
        marks = np.flatnonzero(text == HASH)
        newlines = np.flatnonzero(text == NEWLINE)
        ends, kept = np.unique(newlines[np.searchsorted(newlines, marks)], return_index=True)
        text[spans(marks[kept], ends - marks[kept])] = BLANK

    def _join_continued(self) -> None:
        text = self.text
        marks = np.flatnonzero(text == BACKSLASH)
        for skip in (1, 2):  # a line may end with \n or \r\n, whose \r is blank by now
            at = marks[marks + skip < len(self.data)]
            between = BACKSLASH if skip == 1 else BLANK
            at = at[(text[at + skip] == NEWLINE) & (text[at + skip - 1] == between)]
            if skip == 2:
                at = at[np.array([self.data[i + 1] == RETURN for i in at.tolist()], dtype=bool)]
            text[at] = text[at + skip] = BLANK

    def keyword_lines(self, keyword: bytes) -> NDArray[np.bool_]:
        """Which lines begin with this word, (L,)."""
        found = self.counts > 0
        at = self.tokens[self.first[found]]
        same = np.ones(len(at), dtype=bool)
        for k, letter in enumerate(keyword):
            same &= self.text.take(at + k, mode="clip") == letter
        found[found] = same & (self.text.take(at + len(keyword), mode="clip") <= BLANK)
        return found

    def words(self, lines: NDArray[np.int64]) -> list[bytes]:
        """All words of these (ascending) lines."""
        chosen = np.zeros(len(self.starts), dtype=bool)
        chosen[lines] = True
        return self.text[np.repeat(chosen, self.ends - self.starts)].tobytes().split()

    def floats(self, lines: NDArray[np.int64], skip: int, width: int, least: int) -> NDArray[np.float64]:
        """The ``width`` numbers after each line's first ``skip`` words, (len(lines), width).

        At least ``least`` must be there, the others are 0 where missing.
        """
        counts = self.counts[lines]
        short = np.flatnonzero(counts < skip + least)
        if len(short):
            raise self.error(int(lines[short[0]]), f"{least} numbers expected")
        column = np.arange(skip, skip + width)
        at = (np.cumsum(counts) - counts)[:, None] + column
        at = np.where(column < counts[:, None], at, -1)
        words = np.array([*self.words(lines), b"0"], dtype=object)[at].ravel().tolist()
        try:
            if b"_" in self.data and any(b"_" in word for word in words):
                raise ValueError("1_0 is a number to Python, but not in a file")
            return np.array(list(map(float, words)), dtype=np.float64).reshape(-1, width)
        except ValueError:
            bad = next(i for i, word in enumerate(words) if not _is_number(word))
            raise self.error(int(lines[bad // width]), "a word that is not a number") from None

    def number(self, line: int) -> int:
        """The line's number in the file, from 1; a continued line counts as the several that it is."""
        newline = b"\n" if b"\n" in self.data else b"\r"
        return self.data.count(newline, 0, int(self.starts[line])) + 1

    def error(self, line: int, what: str) -> FileFormatError:
        """The refusal of a line: where it is, what is wrong, what it says."""
        quoted = self.data[self.starts[line]:self.ends[line]].strip()[:60].decode("latin-1")
        return FileFormatError(f"{self.path}, line {self.number(line)}: {what}: {quoted!r}; "
                               "correct the line or export the file again")


def _is_number(word: bytes) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return b"_" not in word
