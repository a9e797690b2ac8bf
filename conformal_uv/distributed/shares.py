"""Numbers 0 .. n - 1 shared out among ranks in blocks, and values of numbers that other ranks own."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .ranks import Ranks

__all__ = ["Borrowed", "Shares", "fetched", "lowered"]

Array = NDArray[Any]
Ints = NDArray[np.int64]


class Shares:
    """Who owns which numbers.

    Attributes
    ----------
    bounds : (size + 1,) int64
        Rank r owns bounds[r] .. bounds[r + 1] - 1.
    first, last, count : int
        This rank's first number, the one after its last, and how many there are of all.
    """

    def __init__(self, ranks: Ranks, bounds: Ints) -> None:
        self.bounds = bounds
        self.first, self.last, self.count = int(bounds[ranks.rank]), int(bounds[ranks.rank + 1]), int(bounds[-1])

    @classmethod
    def of_counts(cls, ranks: Ranks, own: int) -> Shares:
        """Each rank owns so many."""
        return cls(ranks, np.concatenate(([0], np.cumsum(ranks.each(int(own))))).astype(np.int64))

    @classmethod
    def even(cls, ranks: Ranks, count: int) -> Shares:
        """So many in all, each rank about as many."""
        return cls(ranks, np.arange(ranks.size + 1, dtype=np.int64) * count // ranks.size)

    def owner(self, numbers: Array) -> Ints:
        """The rank of each number."""
        return np.searchsorted(self.bounds, numbers, side="right") - 1

    def owned(self, numbers: Array) -> NDArray[np.bool_]:
        """Which of them are this rank's."""
        return (numbers >= self.first) & (numbers < self.last)


class Borrowed:
    """Values of some numbers, ascending, that other ranks own, asked for again and again.

    Attributes
    ----------
    numbers : (k,) int64
    lent : (l,) int64
        This rank's own numbers, counted from its first, that others have borrowed, one rank's after the other's.
    """

    def __init__(self, ranks: Ranks, shares: Shares, numbers: Ints) -> None:
        self._ranks, self.numbers = ranks, numbers
        self._in, self._out = ranks.counted(shares.owner(numbers))
        self.lent = ranks.sent(numbers, self._in, self._out) - shares.first

    def values(self, own: Array) -> Array:
        """Of own values (count, ...), those borrowed from others, (k, ...)."""
        return self._ranks.sent(own[self.lent], self._out, self._in)


def fetched(ranks: Ranks, shares: Shares, own: Array, numbers: Array) -> Array:
    """Values of any numbers, those of this rank among them."""
    asked, back = np.unique(numbers, return_inverse=True)
    return Borrowed(ranks, shares, asked.astype(np.int64)).values(own)[back]


def lowered(ranks: Ranks, shares: Shares, own: Ints, numbers: Ints, values: Ints) -> None:
    """Own values (count,) made as low as any of those that ranks name for some numbers."""
    order = np.lexsort((values, numbers))
    numbers, values = numbers[order], values[order]
    lowest = np.diff(numbers, prepend=-1) != 0
    numbers, values = numbers[lowest], values[lowest]
    at, least = ranks.exchanged(shares.owner(numbers), numbers, values)
    np.minimum.at(own, at - shares.first, least)
