"""Replace many short spans of a long text at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["spliced"]

Ints = NDArray[np.int64]
Bytes = NDArray[np.uint8]


def spliced(text: bytes, starts: Ints, ends: Ints, replacement: Bytes, lengths: Ints) -> bytes:
    """``text`` with the spans start to end, ascending and apart, replaced.

    ``replacement`` holds the new texts run together, ``lengths`` the length of each.
    """
    source = np.frombuffer(text, np.uint8)
    kept = np.append(starts, len(source)) - np.concatenate([np.zeros(1, np.int64), ends])
    old = np.repeat(_alternating(len(starts)), _interleaved(kept, ends - starts))
    new = np.repeat(_alternating(len(starts)), _interleaved(kept, lengths))
    result = np.empty(len(new), np.uint8)
    result[new] = source[old]
    result[~new] = replacement
    return result.tobytes()


def _alternating(count: int) -> NDArray[np.bool_]:
    return np.arange(2 * count + 1) % 2 == 0


def _interleaved(kept: Ints, between: Ints) -> Ints:
    lengths = np.empty(len(kept) + len(between), np.int64)
    lengths[::2], lengths[1::2] = kept, between
    return lengths
