"""Numbers of a text, all at once: plain decimals word by word, others by numpy's own parser."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .plain_numbers import plain_floats

MOST = 10**18

__all__ = ["float_numbers", "in_32_bits", "whole_numbers"]


def float_numbers(text: bytes, count: int) -> NDArray[np.float64] | None:
    """The words of a text as doubles, correctly rounded; None if they are not so many numbers."""
    plain = plain_floats(text, count)
    return _numbers(text, count, np.float64) if plain is None else plain


def whole_numbers(text: bytes, count: int) -> NDArray[np.int64] | None:
    """The words of a text as integers; None if they are not so many whole numbers, or one is beyond 18 digits."""
    found = _numbers(text, count, np.int64)
    return None if found is None or (found >= MOST).any() or (found <= -MOST).any() else found


def _numbers(text: bytes, count: int, kind: type[Any]) -> NDArray[Any] | None:
    """It stops at what is no number, so that the 0 put behind is missing, and takes "1.5.2" or "1-2" for two."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # that it stopped
        try:
            found = np.fromstring(text + b" 0", kind, sep=" ")
        except ValueError:
            return None
    return found[:-1] if len(found) == count + 1 else None


def in_32_bits(indices: NDArray[np.int64]) -> NDArray[np.int32]:
    """Indices and sizes in half the memory; what does not fit is of no file, and stays beyond all others."""
    return np.clip(indices, -1, np.iinfo(np.int32).max).astype(np.int32)
