"""A text mesh file as lines and tokens, found for the whole file at once."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from conformal_uv.errors import FileFormatError

__all__ = ["TextLines", "spans"]

NEWLINE, RETURN, BLANK, HASH, BACKSLASH = b"\n\r #\\"
BLOCK = 1 << 22  # bytes looked at together
BYTE_ORDER_MARK = b"\xef\xbb\xbf"

Ints = NDArray[np.int64]


def spans(starts: Ints, lengths: Ints) -> Ints:
    """The indices start, start + 1, ... of every span, one span after the other."""
    offsets = np.cumsum(lengths) - lengths
    return np.repeat(starts - offsets, lengths) + np.arange(int(lengths.sum()))


class TextLines:
    """Lines of a text file of numbers, with comments (``#``) and line continuations (``\\``) blanked.

    Lines end with LF, CR LF or, in a file without LF, CR; a UTF-8 byte order mark is a blank. Lines without a word
    are left out, so that memory is bounded by what the file says.

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

    Raises
    ------
    FileFormatError
        The file is in UTF-16.
    """

    def __init__(self, path: Path, data: bytes) -> None:
        self.path = path
        self.data = data
        if data.startswith((b"\xff\xfe", b"\xfe\xff")):
            raise FileFormatError(f"{path}: the text is in UTF-16; save it as UTF-8")
        self.text = text = np.append(np.frombuffer(data, np.uint8), np.uint8(NEWLINE))
        if data.startswith(BYTE_ORDER_MARK):
            text[: len(BYTE_ORDER_MARK)] = BLANK
        lone_returns = b"\n" not in data
        hashes = b"#" in data
        comment = False
        for begin in range(0, len(text), BLOCK):
            block = text[begin : begin + BLOCK]
            if lone_returns:
                block[block == RETURN] = NEWLINE
            np.putmask(block, (block < BLANK) & (block != NEWLINE), BLANK)
            if hashes:
                comment = _blank_comments(block, comment)
        if b"\\" in data:
            self._join_continued()
        self._find_words()

    def _find_words(self) -> None:
        """Words and the lines that have any, a block at a time."""
        text = self.text
        tokens, starts, ends, counts = ([np.empty(0, dtype=np.int64)] for _ in range(4))
        inked_before, open_line, words_before = False, 0, 0
        for begin in range(0, len(text), BLOCK):
            block = text[begin : begin + BLOCK]
            inked = block > BLANK
            begins = inked.copy()
            begins[1:] &= ~inked[:-1]
            begins[0] &= not inked_before
            inked_before = bool(inked[-1])
            here = np.flatnonzero(begins)
            newlines = np.flatnonzero(block == NEWLINE)
            words = np.searchsorted(here, newlines)  # up to the end of each line
            words = np.diff(words, prepend=0)
            if len(newlines):
                words[0] += words_before
                line_starts = np.concatenate(([open_line], begin + newlines[:-1] + 1))
                has = words > 0
                starts.append(line_starts[has])
                ends.append(begin + newlines[has] + 1)
                counts.append(words[has])
                open_line = begin + int(newlines[-1]) + 1
                words_before = len(here) - int(np.searchsorted(here, newlines[-1]))
            else:
                words_before += len(here)
            tokens.append(here + begin)
        self.tokens = np.concatenate(tokens)
        self.starts, self.ends, self.counts = np.concatenate(starts), np.concatenate(ends), np.concatenate(counts)
        self.first = np.cumsum(self.counts) - self.counts

    def _join_continued(self) -> None:
        text = self.text
        marks = np.concatenate(
            [b + np.flatnonzero(text[b : b + BLOCK] == BACKSLASH) for b in range(0, len(text), BLOCK)]
        )
        for skip in (1, 2):  # a line may end with \n or \r\n, whose \r is blank by now
            at = marks[marks + skip < len(self.data)]
            between = BACKSLASH if skip == 1 else BLANK
            at = at[(text[at + skip] == NEWLINE) & (text[at + skip - 1] == between)]
            if skip == 2:
                at = at[np.array([self.data[i + 1] == RETURN for i in at.tolist()], dtype=bool)]
            text[at] = text[at + skip] = BLANK

    def runs(self, lines: Ints) -> tuple[Ints, Ints]:
        """Stretches of the text that these (ascending) lines fill: where each begins and ends."""
        if not len(lines):
            return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
        apart = np.flatnonzero(self.starts[lines[1:]] != self.ends[lines[:-1]])
        begins = self.starts[lines[np.concatenate(([0], apart + 1))]]
        return begins, self.ends[lines[np.concatenate((apart, [len(lines) - 1]))]]

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
        stretches = zip(*(ends.tolist() for ends in self.runs(lines)), strict=True)
        return b"".join(self.text[begin:end].tobytes() for begin, end in stretches).split()

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
        quoted = self.data[self.starts[line] : self.ends[line]].strip()[:60].decode("latin-1")
        return FileFormatError(
            f"{self.path}, line {self.number(line)}: {what}: {quoted!r}; correct the line or export the file again"
        )


def _blank_comments(block: NDArray[np.uint8], comment: bool) -> bool:
    """Blank what follows a # on its line; `comment` says whether the block begins inside such, and so does what is
    returned of its end."""
    marks = np.flatnonzero(block == HASH)
    if not len(marks) and not comment:
        return False
    newlines = np.flatnonzero(block == NEWLINE)
    if comment:
        marks = np.concatenate(([0], marks))
    after = np.searchsorted(newlines, marks)
    stops = np.append(newlines, len(block))
    ends, kept = np.unique(after, return_index=True)
    begins, lasts = marks[kept], stops[ends]
    change = np.zeros(len(block) + 1, dtype=np.int8)
    change[begins] += 1
    change[lasts] -= 1
    block[np.cumsum(change[:-1], dtype=np.int8).astype(bool)] = BLANK
    return bool(ends[-1] == len(newlines))


def _is_number(word: bytes) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return b"_" not in word
