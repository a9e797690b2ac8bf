"""Charts packed by their outlines into the least square that is found."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .cell_packing import pack_cells
from .footprints import Footprints, footprints
from .outlines import Outlines

__all__ = ["pack_by_outline"]

Ints = NDArray[np.int64]
Complex = NDArray[np.complex128]

FEWEST_CELLS, MOST_CELLS = 320, 640  # along the square's side; the time grows with their square
CELLS_OF_CHART = 30  # across one, where all are alike
PARTS = (0.5, 0.7, 1.0)  # of these cells, in turn: a coarse grid may pack by chance what a fine one does not
PRECISION = 200  # the search for the side ends at this part of it


def pack_by_outline(outlines: Outlines, margin: float, enough: float) -> tuple[Complex, float] | None:
    """Where the corners of the charts' boxes come (k,), and the side of the square around them.

    Charts keep `margin` times the side from each other and from the square's sides. None where no side less than
    `enough` is found.
    """
    cells = np.clip(CELLS_OF_CHART * np.sqrt(len(outlines)), FEWEST_CELLS, MOST_CELLS)
    best = None
    for part in PARTS:
        found = _packed(outlines, enough / int(part * cells), margin, enough)
        if found is not None:
            best, enough = found, found[1]
    return best


def _packed(outlines: Outlines, cell: float, margin: float, enough: float) -> tuple[Complex, float] | None:
    """The same on one grid."""
    grid, best = _Grid.of(outlines, cell, margin * enough), None
    least, most = grid.least(), grid.cells_within(enough)
    while most - least > max(1, most // PRECISION):
        middle = (least + most) // 2
        found = pack_cells(grid.found, middle)
        if found is None:
            least = middle
        else:
            best, most = grid.places(*found), grid.extent(*found)
    return best


@dataclass(frozen=True, eq=False)
class _Grid:
    """Charts on a grid; a cell is always free between two of them, and `found.around` cells are kept at each."""

    found: Footprints
    cell: float
    outside: float  # to the sides of the square, beyond what is kept around each chart

    @classmethod
    def of(cls, outlines: Outlines, cell: float, gap: float) -> _Grid:
        found = footprints(outlines, cell, max(0.0, 0.5 * (gap / cell - 1.0)))
        return cls(found, cell, max(0.0, gap - found.around * cell))

    def least(self) -> int:
        """Cells along a side that is too short."""
        area = np.sqrt((self.found.stop - self.found.start).sum())
        return int(max(area, self.found.columns.max(), self.found.rows.max())) - 1

    def cells_within(self, side: float) -> int:
        return int((side - 2.0 * self.outside) / self.cell)

    def extent(self, column: Ints, row: Ints) -> int:
        return int(max((column + self.found.columns).max(), (row + self.found.rows).max()))

    def places(self, column: Ints, row: Ints) -> tuple[Complex, float]:
        inside = self.found.around * self.cell + self.outside
        place = self.cell * (column + 1j * row) + inside * (1 + 1j)
        return place, self.cell * self.extent(column, row) + 2.0 * self.outside
