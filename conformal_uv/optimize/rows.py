"""What iterations on many small problems at once share: a row of variables for each, and each row's own steps.

`line_search` and its history, row by row.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from .history import NewtonStep
from .line_search import HALVINGS, SUFFICIENT_DECREASE

__all__ = ["RowStep", "line_search_rows", "row_history"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]


class RowStep(NamedTuple):
    """A step of some rows (k,), ascending: values and gradients' norms before it, and parts of the direction taken."""

    row: Ints
    value: Real
    norm: Real
    length: Real


def row_history(steps: Sequence[RowStep], row: int, value: float, norm: float) -> tuple[NewtonStep, ...]:
    """The iterates of one row, the last of them with this value and norm; directions took no conjugate gradients."""
    made = []
    for step in steps:
        at = int(np.searchsorted(step.row, row))
        if at < len(step.row) and step.row[at] == row:
            made.append(NewtonStep(float(step.value[at]), float(step.norm[at]), 0, float(step.length[at])))
    return (*made, NewtonStep(float(value), float(norm), 0, 0.0))


class Rows(Protocol):
    """The values (k,) of some rows at their points (k, n), and the norms of their gradients."""

    @property
    def point(self) -> Real: ...

    @property
    def value(self) -> Real: ...

    @property
    def norm(self) -> Real: ...


Place = TypeVar("Place", bound=Rows)


def line_search_rows(
    here: Rows, slope: Real, noise: Real, move: Callable[[Ints, float], Place]
) -> tuple[Real, Real, Place | None]:
    """Parts (r,) of the directions, 0 where no step does, the points (r, n) there, and the place itself where all rows
    took the whole step.

    Parameters
    ----------
    slope, noise : (r,) float64
        Derivatives along the directions, and roundings of the differences of two values.
    move : callable
        Some rows (k,) after a step of this length.
    """
    taken, point = np.zeros(len(slope)), here.point.copy()
    left, length = np.arange(len(slope)), 1.0
    for _ in range(HALVINGS):
        there = move(left, length)
        change = there.value - here.value[left]
        falls = (change <= SUFFICIENT_DECREASE * length * slope[left]) & (change < -noise[left])
        falls |= (np.abs(change) <= noise[left]) & (there.norm < here.norm[left])
        taken[left[falls]], point[left[falls]] = length, there.point[falls]
        if falls.all():
            return taken, point, there if len(left) == len(taken) else None
        left, length = left[~falls], 0.5 * length
    return taken, point, None
