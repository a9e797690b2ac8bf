"""Replace many short spans of a long text at once."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["decimal_texts", "spliced"]

Ints = NDArray[np.int64]
Bytes = NDArray[np.uint8]


def decimal_texts(values: Ints, prefix: bytes) -> tuple[Bytes, Ints]:
    """Integers >= 0 in decimal, each after a one-letter prefix: the text run together and the lengths."""
    width = len(str(int(values.max(initial=0))))
    table = np.empty((len(values), width + 1), np.uint8)
    table[:, 0] = prefix[0]
    rest: NDArray[Any] = values.astype(np.int32 if width < 10 else np.int64)
    lengths = np.full(len(values), 2, np.int64)
    for k in range(width, 0, -1):
        tenth = rest // 10
        table[:, k] = rest - 10 * tenth + ord("0")
        rest = tenth
        lengths += (rest > 0) & (k > 1)
    keep = np.arange(width, -1, -1) < (lengths - 1)[:, None]
    keep[:, 0] = True
    return table[keep], lengths


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
