"""One fraction over all charts, from what the map of each chart reports."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..progress import Callback, Progress

__all__ = ["ChartProgress"]

STAGES = {  # where each stage of a map begins and ends, as a part of the whole map
    "checks": (0.0, 0.05),
    "assembly": (0.05, 0.15),
    "ordering": (0.15, 0.2),
    "factorization": (0.2, 0.5),
    "linear": (0.5, 0.6),
    "newton": (0.6, 0.9),
    "augmented lagrangian": (0.2, 0.9),
    "placement": (0.9, 0.95),
    "repair": (0.95, 1.0),
}
SPLITTING, PLACING = 0.05, 0.95  # the fractions at which splitting ends and placing begins


class ChartProgress:
    """Passes the stages of each chart's map on with a fraction that never falls.

    Parameters
    ----------
    callback : callable, optional
        As in `unwrap`; CancelledError when it returns False.
    """

    def __init__(self, callback: Callback | None) -> None:
        self._progress = Progress(callback)
        self._reached = 0.0
        self._ends: NDArray[np.float64] = np.zeros(1)
        self._chart = 0
        self.wanted = callback is not None

    def report(self, stage: str, fraction: float) -> None:
        """Report a fraction of the whole."""
        self._reached = max(self._reached, fraction)
        self._progress(stage, self._reached)

    def weigh(self, triangles: NDArray[np.int64]) -> None:
        """Set the share of each chart (count,); charts are mapped from the first on."""
        ends = np.concatenate(([0.0], np.cumsum(triangles)))
        self._ends = SPLITTING + (PLACING - SPLITTING) * ends / max(ends[-1], 1.0)

    def start(self, chart: int) -> None:
        """What follows is about this chart."""
        self._chart = chart

    def __call__(self, stage: str, fraction: float) -> None:
        """The callback given to a map."""
        low, high = STAGES.get(stage, (0.0, 0.0))
        part = low + (high - low) * fraction
        begin, end = self._ends[self._chart], self._ends[self._chart + 1]
        self.report(stage, float(begin + (end - begin) * part))
