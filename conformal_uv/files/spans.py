"""The indices of many spans, run together."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["spans"]

Ints = NDArray[np.int64]


def spans(starts: Ints, lengths: Ints) -> Ints:
    """The indices start, start + 1, ... of every span, one span after the other."""
    offsets = np.cumsum(lengths) - lengths
    return np.repeat(starts - offsets, lengths) + np.arange(int(lengths.sum()))
