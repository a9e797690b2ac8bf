"""Where on a grid of cells charts are free to lie: all places of one asked at once, on bits.

A row of a chart is free at x where no bit from x on is set over the row's length; for all x that is two lookups in the
rows widened by powers of two. With the eight shifts of each of these kept, a lookup is a slice of bytes.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

__all__ = ["NOWHERE", "FreeCells", "Stencil"]

Ints = NDArray[np.int64]
Bytes = NDArray[np.uint8]

BITS = 8
FULL = (1 << BITS) - 1
FIRST_FREE = np.array([(~byte & (byte + 1)).bit_length() - 1 for byte in range(1 << BITS)], dtype=np.int64)
NOWHERE = np.iinfo(np.int32).max


@dataclass(frozen=True, eq=False)
class Stencil:
    """The cells of one chart, turned in one way: runs (r,) of its rows.

    Attributes
    ----------
    row, start, stop : (r,) int64
        Row, first cell and the first one behind it.
    columns, rows : int
        Of the grid around them.
    """

    row: Ints
    start: Ints
    stop: Ints
    columns: int
    rows: int

    @cached_property
    def powers(self) -> int:
        """Powers of two up to the longest run."""
        return int((self.stop - self.start).max()).bit_length()

    @cached_property
    def lookups(self) -> list[tuple[int, int, int, int]]:
        """Power, shift, row and byte of what decides about each run, each once."""
        power = np.frexp((self.stop - self.start).astype(np.float64))[1].astype(np.int64) - 1
        column = np.stack((self.start, self.stop - (1 << power)))
        asked = np.stack(np.broadcast_arrays(power, column % BITS, self.row, column // BITS))
        return list(dict.fromkeys(zip(*asked.reshape(4, -1).tolist(), strict=True)))


class FreeCells:
    """A square grid, empty at first.

    Parameters
    ----------
    side : int
        Cells along its sides.
    powers : int
        The most that a chart is going to need.
    """

    def __init__(self, side: int, powers: int) -> None:
        self.side = side
        self._bytes = side // BITS + 1
        self._filled: Bytes = np.zeros((side, self._bytes), dtype=np.uint8)
        # [power, shift, byte]: bits with a filled one among the 2^power from them on, moved down by the shift
        self._near: Bytes = np.zeros((powers, BITS, self._bytes * (side + 1)), dtype=np.uint8)

    def first_free(self, stencil: Stencil, highest: int) -> Ints:
        """For each row from 0 to `highest` the first column where the chart may lie; NOWHERE where there is none."""
        rows, last = min(highest, self.side - stencil.rows) + 1, self.side - stencil.columns
        if rows <= 0 or last < 0:
            return np.empty(0, dtype=np.int64)
        taken = np.zeros(rows * self._bytes, dtype=np.uint8)
        for power, shift, row, byte in stencil.lookups:
            begin = row * self._bytes + byte
            np.bitwise_or(taken, self._near[power, shift, begin : begin + len(taken)], out=taken)
        grid = taken.reshape(rows, self._bytes)
        first = (grid != FULL).argmax(axis=1)
        byte_there = grid[np.arange(rows), first]
        found = BITS * first + FIRST_FREE[byte_there]
        return np.where((byte_there != FULL) & (found <= last), found, NOWHERE)

    def fill(self, stencil: Stencil, column: int, row: int, powers: int) -> None:
        """Put the chart there; charts that are asked for from now on need no more than so many powers."""
        here = slice(row, row + stencil.rows)
        cells = np.zeros((stencil.rows, BITS * self._bytes + 1), dtype=np.int8)
        np.add.at(cells, (stencil.row, column + stencil.start), 1)
        np.add.at(cells, (stencil.row, column + stencil.stop), -1)
        covered = np.cumsum(cells[:, :-1], axis=1, dtype=np.int8)
        self._filled[here] |= np.packbits(covered.astype(bool), axis=1, bitorder="little")
        near = np.zeros((stencil.rows, self._bytes + (1 << max(powers, 3)) // BITS + 1), dtype=np.uint8)
        near[:, : self._bytes] = self._filled[here]
        span = slice(row * self._bytes, (row + stencil.rows) * self._bytes)
        for power in range(powers):
            wide = near[:, :-1] | (near[:, 1:].astype(np.uint16) << BITS)
            moved = (wide[None, :, : self._bytes] >> np.arange(BITS, dtype=np.uint16)[:, None, None]).astype(np.uint8)
            self._near[power, :, span] = moved.reshape(BITS, -1)
            step = 1 << power
            if step < BITS:
                near[:, :-1] |= (wide >> np.uint16(step)).astype(np.uint8)
            else:
                near[:, : -(step // BITS)] |= near[:, step // BITS :].copy()
