"""Floating-point numbers as the shortest decimals that read back the same, many at once.

A number's 17 digits are those of its product with a power of ten, exact in the sum of two doubles ; fewer
digits do where what they say is nearer to the number than half the way to the next one.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .digits import FOUR, TEN, WORD, compacted, digit_words, first_letters
from .exact import half_gaps, product

__all__ = ["float_rows"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

NUMBERS = 1 << 14  # worked on together, so that they stay in the cache

LEAST = 1e-3
MOST = {np.dtype(np.float64): 1e15, np.dtype(np.float32): 2.0**24}
"""Between these a number is written without an exponent, and its whole part exactly; Python writes the others."""

SHORTER = {np.dtype(np.float64): (16, 15), np.dtype(np.float32): (9, 8, 7, 6)}
"""How many digits may do instead of 17, from most to least."""

PRECISION = {np.dtype(np.float64): 53, np.dtype(np.float32): 24}

MARGIN = 1 - 2.0**-40  # the comparison with half a gap is itself rounded
BEHIND = 19  # digits behind the point at most
POWER = 10.0 ** np.arange(BEHIND + 1)
NEXT = np.array([float(f"1e{k}") for k in range(-3, 16)])
ORDER = np.floor(np.arange(-10, 50) * np.log10(2.0)).astype(np.int64)
"""The decimal orders of 2**-10, 2**-9 ...; a number up to the double of one has that order or the next."""

POINT = np.array([b".%03d" % k for k in range(1000)]).view(WORD)
AS_FAR_AS = first_letters(5)
LONGEST = 24  # letters of a number with an exponent


def float_rows(values: NDArray[Any], prefix: bytes = b"", end: bytes = b"") -> tuple[bytes, Ints]:
    """The rows of a table of numbers as texts, each number as `repr` writes it.

    Parameters
    ----------
    values : (n, c) float64 or float32
        The numbers; a blank is put before each.
    prefix, end : bytes
        What stands before and behind each row: two letters and four at most.

    Returns
    -------
    texts : bytes
        All rows' texts run together.
    lengths : (n,) int64
        The length of each.
    """
    texts, lengths = [], [np.empty(0, np.int64)]
    step = max(NUMBERS // values.shape[1], 1)
    for begin in range(0, len(values), step):
        text, length = _some_rows(values[begin : begin + step], prefix, end)
        texts.append(text)
        lengths.append(length)
    return b"".join(texts), np.concatenate(lengths)


def _some_rows(values: NDArray[Any], prefix: bytes, end: bytes) -> tuple[bytes, Ints]:
    """A table with room for every letter that a number may have, 0 for those that it has not."""
    flat = values.ravel()
    size = np.abs(flat).astype(np.float64)
    plain = (size >= LEAST) & (size < MOST[flat.dtype])
    size[~plain] = 1.0
    plain |= flat == 0
    whole = size.astype(np.int64)
    fraction = _fraction(size, whole, flat.dtype)
    whole[flat == 0] = 0
    minus = plain & np.signbit(flat)
    digits, before = digit_words(whole)
    point, behind = _point_words(fraction)
    lengths = 2 + minus + before + behind

    columns = values.shape[1]
    table = np.zeros((len(values), columns * (len(digits) + 6) + 1), WORD)
    numbers = table[:, :-1].reshape(len(values), columns, -1)
    signs = _signs(prefix, columns)
    numbers[:, :, 0] = np.where(minus.reshape(-1, columns), signs[1], signs[0])
    for k, word in enumerate(digits + point):
        numbers[:, :, k + 1] = word.reshape(-1, columns)
    table[:, -1] = np.frombuffer(end.ljust(4, b"\0"), WORD)
    odd = np.flatnonzero(~plain)
    if len(odd):
        texts = flat[odd].astype(f"S{LONGEST}").view(WORD).reshape(len(odd), -1)
        row, column = np.divmod(odd, columns)
        numbers[row, column, 1:] = 0
        numbers[row, column, 1 : 1 + texts.shape[1]] = texts
        lengths[odd] = 1 + np.count_nonzero(texts.view(np.uint8), axis=1)
    return compacted(table), lengths.reshape(-1, columns).sum(axis=1) + len(prefix) + len(end)


def _signs(prefix: bytes, columns: int) -> NDArray[np.uint32]:
    """What stands before the first number of a row and the others, without and with a minus, (2, columns)."""
    heads = [prefix.rjust(2, b"\0"), *[b"\0\0"] * (columns - 1)]
    return np.frombuffer(b"".join(head + b" " + sign for sign in (b"\0", b"-") for head in heads), WORD).reshape(2, -1)


def _fraction(size: Floats, whole: Ints, kind: np.dtype[Any]) -> NDArray[np.uint64]:
    """What the shortest decimals have behind the point, in units of 10**-19."""
    bits = size.view(np.int64)
    order = ORDER[(bits >> 52) - (1023 - 10)]
    order += size >= NEXT[order + 4]
    places = 16 - order
    power = POWER[places]
    high, low = product(size, power)
    near = np.rint(low)
    low -= near
    exact = high.astype(np.int64) + near.astype(np.int64)

    gap = half_gaps(size, PRECISION[kind]) * power * MARGIN
    best = exact
    for count in SHORTER[kind]:
        unit = 10 ** (17 - count)
        rounded = (exact + (unit // 2 - (low < 0))) // unit
        error = rounded * unit - exact
        rounded -= (error == unit // 2) & (low == 0) & (rounded % 2 == 1)  # half-way: the even digit
        best = np.where(np.abs(error - low) < gap, rounded * unit, best)
    return (best - whole * TEN[places].view(np.int64)).view(np.uint64) * TEN[BEHIND - places]


def _point_words(fraction: NDArray[np.uint64]) -> tuple[list[NDArray[np.uint32]], Ints]:
    """The point and what is behind it without zeros at its end, as words, and the number of digits."""
    zeros = np.zeros(len(fraction), np.int64)
    rest = fraction
    for k in (16, 8, 4, 2, 1):
        tenth = rest // TEN[k]
        whole = tenth * TEN[k] == rest
        rest = np.where(whole, tenth, rest)
        zeros += k * whole
    behind = np.maximum(BEHIND - zeros, 1)
    words, rest = [], fraction
    for k in range(4, 0, -1):
        above = rest // TEN[4]
        words.append(FOUR[(rest - TEN[4] * above).view(np.int64)] & AS_FAR_AS[behind + 1, k])
        rest = above
    words.append(POINT[rest.view(np.int64)] & AS_FAR_AS[behind + 1, 0])
    return words[::-1], behind
