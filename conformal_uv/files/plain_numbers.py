"""Plain decimals such as -12.5 read from a text all at once, eight digits of each as one word.

A number is the quotient of its digits by a power of ten, corrected by the remainder, which is exact in two doubles.
That rounds correctly: with 8 digits before the point and k <= 19 behind it, a decimal times 10**k 2**j and the middle
between two doubles times the same, j >= 26, are different multiples of 2**k, so that they are further apart than 5**-19
of half the way to the next double, and the correction is known to 2**-52. What is no such decimal is left to Python.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .digits import TEN
from .exact import product
from .spans import spans

__all__ = ["plain_floats"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bytes = NDArray[np.uint8]
Words = NDArray[np.uint64]

WORD = np.dtype("<u8")
BLANK, MINUS, POINT, ZERO = b" -.0"
DIGITS, BEFORE = 19, 8  # a number's digits that fit into an integer; of these before the point
LEFT = 16  # one word of so many may be left to Python
ROOM = b" " * 24  # three words before the end of any number

LAST = np.frombuffer(b"".join(b"\0" * (8 - k) + b"\xff" * k for k in range(9)), WORD)
"""Masks that keep the last 0 to 8 letters of a word."""

POWER = 10.0 ** np.arange(DIGITS + 1)
ZEROS = np.uint64(0x3030303030303030)
PAIRS = np.uint64(0x000000FF000000FF)


def plain_floats(text: bytes, count: int) -> Floats | None:
    """The words of a text as doubles, correctly rounded; None if they are not so many, or many are not plain."""
    if LEFT * (text.count(b"e") + text.count(b"E")) > count:
        return None
    raw = b"".join((ROOM, text, b" "))
    letters = np.frombuffer(raw, np.uint8)
    inked = letters > BLANK
    edges = np.flatnonzero(inked[1:] != inked[:-1]) + 1
    starts, ends = edges[::2], edges[1::2]
    if len(starts) != count or not count:
        return None
    negative = letters[starts] == MINUS
    found = _points(letters, inked, starts, ends, negative)
    if found is None:
        return None
    points, odd = found
    before, behind = points - starts - negative, np.maximum(ends - points - 1, 0)
    odd |= (before > BEFORE) | (behind > DIGITS) | (before + behind == 0)
    before[odd], behind[odd] = 0, 0
    windows: Words = np.ndarray(len(raw) - 7, WORD, raw, strides=(1,))
    whole = _eight(windows[points - 8], before)
    digits = _eight(windows[ends - 8], np.minimum(behind, 8))
    for k in range(8, int(behind.max()), 8):
        digits += _eight(windows[ends - 8 - k], np.clip(behind - k, 0, 8)) * TEN[k]
    odd |= (whole > 0) & (before + behind > DIGITS)
    digits += whole * TEN[behind]
    values = _quotients(digits, POWER[behind])
    left = np.flatnonzero(odd)
    if LEFT * len(left) > count + LEFT:
        return None
    np.negative(values, out=values, where=negative)
    for k in left.tolist():
        word = raw[starts[k] : ends[k]]
        try:
            values[k] = float(word)
        except ValueError:
            return None
        if b"_" in word:
            return None
    return values


def _points(
    letters: Bytes, inked: NDArray[np.bool_], starts: Ints, ends: Ints, negative: NDArray[np.bool_]
) -> tuple[Ints, NDArray[np.bool_]] | None:
    """Where each word's point is, and which words are more than a sign, digits and points; None if others have not one
    point each."""
    points = np.flatnonzero(letters == POINT)
    odd = np.zeros(len(starts), dtype=bool)
    digit = letters - ZERO < 10
    if np.count_nonzero(digit) + len(points) + np.count_nonzero(negative) != np.count_nonzero(inked):
        others = inked & ~digit
        others[starts[negative]] = others[points] = False
        odd[np.searchsorted(starts, np.flatnonzero(others), side="right") - 1] = True
        first = np.searchsorted(points, starts[odd])
        points = np.delete(points, spans(first, np.searchsorted(points, ends[odd]) - first))
    found = ends.copy()
    if len(points) + np.count_nonzero(odd) != len(starts):
        return None
    found[~odd] = points
    inside = (found >= starts + negative) & ((found < ends) | odd)
    return (found, odd) if inside.all() else None


def _eight(words: Words, count: Ints) -> Words:
    """The last digits, so many of each word, as an integer."""
    pairs = (words ^ ZEROS) & LAST[count]
    pairs = pairs * TEN[1] + (pairs >> np.uint64(8))
    upper, lower = pairs & PAIRS, (pairs >> np.uint64(16)) & PAIRS
    return (upper * np.uint64(100 + (10**6 << 32)) + lower * np.uint64(1 + (10**4 << 32))) >> np.uint64(32)


def _quotients(digits: Words, power: Floats) -> Floats:
    """The nearest doubles to digits / power."""
    first = digits.astype(np.float64)
    near = first / power
    if int(digits.max()) <= 2**53:  # exact as a double
        return near
    rest = (digits - first.astype(np.uint64)).view(np.int64).astype(np.float64)
    high, low = product(near, power)
    return near + (first - high - low + rest) / power
