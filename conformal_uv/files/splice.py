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
    kept = np.append(starts, len(source))
    kept[1:] -= ends
    if not np.array_equal(starts, ends):
        source = source[_of_kept(kept, ends - starts)]
    old = _of_kept(kept, lengths)
    result = np.empty(len(old), np.uint8)
    result[old] = source
    result[~old] = replacement
    return result.tobytes()


def _of_kept(kept: Ints, between: Ints) -> NDArray[np.bool_]:
    """True as often as the first of ``kept`` says, False as often as the first of ``between``, and so on."""
    lengths = np.empty(len(kept) + len(between), np.int64)
    lengths[::2], lengths[1::2] = kept, between
    flags = np.zeros(len(lengths), dtype=bool)
    flags[::2] = True
    return np.repeat(flags, lengths)
