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
        self._weights: NDArray[np.float64] = np.ones(1)
        self._done = self._begun = 0.0
        self.wanted = callback is not None

    def report(self, stage: str, fraction: float) -> None:
        """Report a fraction of the whole."""
        self._reached = max(self._reached, fraction)
        self._progress(stage, self._reached)

    def weigh(self, triangles: NDArray[np.int64]) -> None:
        """Set the share of each chart (count,)."""
        self._weights = triangles / max(float(triangles.sum()), 1.0)

    def start(self, charts: int | NDArray[np.int64]) -> None:
        """What follows is about this chart, or about these together; those before are done."""
        self._done += self._begun
        self._begun = float(self._weights[charts].sum())

    def __call__(self, stage: str, fraction: float) -> None:
        """The callback given to a map."""
        low, high = STAGES.get(stage, (0.0, 0.0))
        part = self._done + self._begun * (low + (high - low) * fraction)  # more than 1 where charts are begun again
        self.report(stage, SPLITTING + (PLACING - SPLITTING) * min(part, 1.0))
