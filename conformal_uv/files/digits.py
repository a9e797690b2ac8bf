"""Decimal digits four at a time: a word of four letters for each, masks for those that do not count, which become 0."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["FOUR", "TEN", "WORD", "compacted", "digit_words", "first_letters", "last_letters", "whole_texts"]

Ints = NDArray[np.int64]
Words = NDArray[np.uint32]

WORD = np.dtype("<u4")
TEN = 10 ** np.arange(20, dtype=np.uint64)
FOUR: Words = np.array([b"%04d" % k for k in range(10000)]).view(WORD)


def last_letters(words: int) -> Words:
    """Masks that keep the last 0, 1, 2 ... letters of so many words, one mask a row."""
    size = 4 * words
    return _masks([b"\0" * (size - k) + b"\xff" * k for k in range(size + 1)])


def first_letters(words: int) -> Words:
    """Masks that keep the first 0, 1, 2 ... letters of so many words, one mask a row."""
    size = 4 * words
    return _masks([b"\xff" * k + b"\0" * (size - k) for k in range(size + 1)])


def _masks(rows: list[bytes]) -> Words:
    return np.frombuffer(b"".join(rows), WORD).reshape(len(rows), -1)


def digit_words(values: Ints) -> tuple[list[Words], Ints]:
    """Integers >= 0 in words of four digits, from the first word to the last, and the number of each one's digits; what
    stands before them is 0."""
    most = len(str(int(values.max(initial=0))))
    lengths = np.ones(len(values), np.int64)
    for k in range(1, most):
        lengths += values >= 10**k
    mask = last_letters(-(-most // 4))
    words, rest = [], values
    for k in range(mask.shape[1] - 1, -1, -1):
        above = rest // 10000
        words.append(FOUR[rest - 10000 * above] & mask[lengths, k])
        rest = above
    return words[::-1], lengths


def compacted(table: Words) -> bytes:
    """The letters that are not 0."""
    return table.tobytes().translate(None, b"\0")


def whole_texts(values: Ints, prefix: bytes) -> tuple[bytes, Ints]:
    """Integers >= 0 in decimal, each after a one-letter prefix: the texts run together and the lengths."""
    words, lengths = digit_words(values)
    head = np.full(len(values), prefix[0], WORD)
    return compacted(np.column_stack((head, *words))), lengths + 1
