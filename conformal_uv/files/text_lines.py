"""A text mesh file as lines and tokens, found for a block of lines at once."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import FileFormatError
from .text_numbers import float_numbers

__all__ = ["TextLines", "text_blocks"]

NEWLINE, RETURN, BLANK, HASH, BACKSLASH = b"\n\r #\\"
BLOCK = 1 << 19  # bytes looked at together
BYTE_ORDER_MARK = b"\xef\xbb\xbf"

Ints = NDArray[np.int64]


def text_blocks(path: Path, data: bytes) -> Iterator[TextLines]:
    """The file's lines, a block at a time; a continued line is in one block. There is one block at least.

    Raises
    ------
    FileFormatError
        The file is in UTF-16.
    """
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise FileFormatError(f"{path}: the text is in UTF-16; save it as UTF-8")
    newline = b"\n" if b"\n" in data else b"\r"
    begin = 0
    while True:
        end = begin + BLOCK
        if end < len(data):
            end = data.rfind(newline, begin, end) + 1 or data.find(newline, end) + 1
            while 0 < end < len(data) and data[end - 3 : end - 1].rstrip(b"\r").endswith(b"\\"):
                end = data.find(newline, end) + 1
        end = end or len(data)
        yield TextLines(path, data, begin, min(end, len(data)), newline)
        begin = end
        if begin >= len(data):
            return


class TextLines:
    """Lines of a text file of numbers, with comments (``#``) and line continuations (``\\``) blanked.

    Lines end with LF, CR LF or, in a file without LF, CR; a UTF-8 byte order mark is a blank. Lines without a word
    are left out, so that memory is bounded by what the file says. All places count from ``begin``.

    Attributes
    ----------
    data : bytes
        The file.
    begin : int
        Where in the file these lines begin.
    text : (N + 1,) uint8
        The lines, byte for byte, with blanks and newlines as their only white space, and a newline.
    starts, ends : (L,) int64
        Each line's span, its newline included; continued lines are one line.
    tokens : (t,) int64
        Where each word begins.
    first, counts : (L,) int64
        Each line's first word (an index into ``tokens``) and number of words.
    """

    def __init__(self, path: Path, data: bytes, begin: int, end: int, newline: bytes) -> None:
        self.path, self.data, self.begin, self.newline = path, data, begin, newline
        raw = data[begin:end]
        self.text = text = np.append(np.frombuffer(raw, np.uint8), np.uint8(NEWLINE))
        if begin == 0 and raw.startswith(BYTE_ORDER_MARK):
            text[: len(BYTE_ORDER_MARK)] = BLANK
        if newline == b"\r":
            text[text == RETURN] = NEWLINE
        if b"#" in raw:
            _blank_comments(text)
        if b"\\" in raw:
            _join_continued(text, raw)
        np.putmask(text, (text < BLANK) & (text != NEWLINE), BLANK)
        inked = text > BLANK
        begins = inked.copy()
        begins[1:] &= ~inked[:-1]
        self.tokens = np.flatnonzero(begins)
        newlines = np.flatnonzero(text == NEWLINE)
        counts = np.diff(np.searchsorted(self.tokens, newlines), prepend=0)
        has = counts > 0
        self.counts = counts[has]
        self.starts, self.ends = np.append(0, newlines[:-1] + 1)[has], newlines[has] + 1
        self.first = np.cumsum(self.counts) - self.counts

    def keyword_lines(self, keyword: bytes) -> NDArray[np.bool_]:
        """Which lines begin with this word, (L,)."""
        found = self.counts > 0
        at = self.tokens[self.first[found]]
        same = np.ones(len(at), dtype=bool)
        for k, letter in enumerate(keyword):
            same &= self.text.take(at + k, mode="clip") == letter
        found[found] = same & (self.text.take(at + len(keyword), mode="clip") <= BLANK)
        return found

    def behind(self, lines: Ints, skip: int) -> tuple[NDArray[np.uint8], Ints]:
        """The text of these (ascending) lines behind each one's first ``skip`` words, run together, and where in
        ``text`` each of its bytes stands."""
        if not len(lines):
            return np.empty(0, np.uint8), np.empty(0, np.int64)
        begin, end = int(self.starts[lines[0]]), int(self.ends[lines[-1]])
        words = np.append(self.tokens, 0)[self.first[lines] + skip]
        marks = np.zeros(end - begin + 1, np.int8)
        marks[np.where(self.counts[lines] > skip, words, self.ends[lines] - 1) - begin] += 1
        marks[self.ends[lines] - begin] -= 1
        at = np.flatnonzero(np.cumsum(marks[:-1], dtype=np.int8).view(np.bool_))
        at += begin
        return self.text[at], at

    def words(self, lines: Ints) -> list[bytes]:
        """All words of these (ascending) lines."""
        return self.behind(lines, 0)[0].tobytes().split()

    def floats(self, lines: Ints, skip: int, width: int, least: int) -> NDArray[np.float64]:
        """The ``width`` numbers after each line's first ``skip`` words, (len(lines), width).

        At least ``least`` must be there, the others are 0 where missing.
        """
        counts = self.counts[lines]
        short = np.flatnonzero(counts < skip + least)
        if len(short):
            raise self.error(int(lines[short[0]]), f"{least} numbers expected")
        if len(lines) and (counts == counts[0]).all() and counts[0] >= skip + width:
            each = int(counts[0]) - skip
            values = float_numbers(self.behind(lines, skip)[0].tobytes(), each * len(lines))
            if values is not None:
                return values.reshape(-1, each)[:, :width]
        column = np.arange(skip, skip + width)
        at = (np.cumsum(counts) - counts)[:, None] + column
        at = np.where(column < counts[:, None], at, -1)
        words = np.array([*self.words(lines), b"0"], dtype=object)[at].ravel().tolist()
        try:
            if any(b"_" in word for word in words):
                raise ValueError("1_0 is a number to Python, but not in a file")
            return np.array(list(map(float, words)), dtype=np.float64).reshape(-1, width)
        except ValueError:
            bad = next(i for i, word in enumerate(words) if not _is_number(word))
            raise self.error(int(lines[bad // width]), "a word that is not a number") from None

    def number(self, line: int) -> int:
        """The line's number in the file, from 1; a continued line counts as the several that it is."""
        return self.data.count(self.newline, 0, self.begin + int(self.starts[line])) + 1

    def error(self, line: int, what: str) -> FileFormatError:
        """The refusal of a line: where it is, what is wrong, what it says."""
        begin, end = self.begin + int(self.starts[line]), self.begin + int(self.ends[line])
        quoted = self.data[begin:end].strip()[:60].decode("latin-1")
        return FileFormatError(
            f"{self.path}, line {self.number(line)}: {what}: {quoted!r}; correct the line or export the file again"
        )


def _blank_comments(text: NDArray[np.uint8]) -> None:
    """Blank what follows a # on its line."""
    marks, newlines = np.flatnonzero(text == HASH), np.flatnonzero(text == NEWLINE)
    ends, first = np.unique(np.searchsorted(newlines, marks), return_index=True)
    change = np.zeros(len(text), np.int8)
    change[marks[first]] += 1
    change[newlines[ends]] -= 1
    text[np.cumsum(change, dtype=np.int8).view(np.bool_)] = BLANK


def _join_continued(text: NDArray[np.uint8], raw: bytes) -> None:
    """Blank a backslash before a line's end, and the end."""
    marks = np.flatnonzero(text == BACKSLASH)
    for skip in (1, 2):  # a line may end with \n or \r\n
        at = marks[marks + skip < len(raw)]
        at = at[(text[at + skip] == NEWLINE) & ((skip == 1) | (text[at + 1] == RETURN))]
        text[at] = text[at + skip] = BLANK


def _is_number(word: bytes) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return b"_" not in word
