"""Products of doubles without a rounding error (Dekker 1971), and how far a double is from the next."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["half_gaps", "product"]

Floats = NDArray[np.float64]

SPLIT = 2.0**27 + 1
FRACTION = (1 << 52) - 1


def product(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """a b as the sum of two doubles."""
    high = a * b
    a_high, a_low = _halves(a)
    b_high, b_low = _halves(b)
    low = a_high * b_high - high
    low += a_high * b_low
    low += a_low * b_high
    low += a_low * b_low
    return high, low


def _halves(a: Floats) -> tuple[Floats, Floats]:
    """The upper and the lower bits."""
    high = a * SPLIT
    high -= high - a
    return high, a - high


def half_gaps(a: Floats, precision: int = 53) -> Floats:
    """Half the way from each number > 0 to the next one of so many bits, down from a power of two, up from others."""
    bits = a.view(np.int64)
    gaps = (bits & ~FRACTION).view(np.float64) * 2.0**-precision
    gaps[(bits & FRACTION) == 0] *= 0.5
    return gaps
