"""Texture coordinates of a whole mesh."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..concise import Concise
from ..errors import ConformalUVError, Remedy, listed
from ..operators.orientation_sign import orientation_signs
from ..shown import Shown
from .chart_list import ChartList

__all__ = ["Unwrapped"]

MOST_REASONS = 8


@dataclass(frozen=True, eq=False, repr=False)
class Unwrapped(Shown, Concise):
    """Texture coordinates on the caller's own polygons.

    Attributes
    ----------
    uv : (k, 2) float64
        Of every polygon corner, polygon after polygon in the caller's order; 0 where nothing was mapped.
    chart_of_face : (p,) int64
        -1 for polygons that were not selected.
    mapped : (p,) bool
        Polygons whose corners have coordinates.
    charts : sequence of Chart
        In the order of their first polygons. Each is made when it is looked at.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> u = cuv.unwrap([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]], rotation=0.0)
    >>> u.uv.shape, u.mapped.tolist(), bool((u.uv >= 0.0).all() and (u.uv <= 1.0).all())
    ((4, 2), [True], True)
    """

    uv: NDArray[np.float64]
    chart_of_face: NDArray[np.int64]
    mapped: NDArray[np.bool_]
    charts: ChartList

    def lost_to_float32(self, uv: NDArray[np.float64] | None = None) -> NDArray[np.int64]:
        """Number of each chart's triangles without positive area where coordinates are kept in single precision.

        That is what textures and modelling programs keep, of islands where they lie; triangles that are folded in
        double precision count too. 0 for charts that failed; (c,) for c charts.

        Parameters
        ----------
        uv : (k, 2) floats, optional
            Coordinates as they are stored, where the caller has moved its islands; by default ``self.uv``.
        """
        charts = self.charts
        stored = np.asarray(self.uv if uv is None else uv).astype(np.float32).astype(np.float64)
        own = charts.mapped[charts.chart_of_triangle]
        lost = orientation_signs(stored, charts.corner[own].T.astype(np.int32)) <= 0
        return np.bincount(charts.chart_of_triangle[own][lost], minlength=len(charts))

    @property
    def summary(self) -> str:
        """How many charts were mapped, and why the others were not, in one line."""
        return self.told()

    def told(self, words: Callable[[Remedy], str] | None = None) -> str:
        """The same, remedies in the words of where it is shown; see `ConformalUVError.told`."""
        errors, count = self.charts.errors, len(self.charts)
        text = f"mapped {count - len(errors)} of {count} chart{'s' * (count != 1)}"
        reasons = [
            f"chart {number} (faces {listed(self.charts[number].faces)}): {error.told(words)}"
            for number, error in list(errors.items())[: MOST_REASONS + 1]
        ]
        if len(reasons) > MOST_REASONS:
            reasons[MOST_REASONS:] = [f"and {len(errors) - MOST_REASONS} more"]
        return "; ".join([text, *reasons])

    def failure(self, words: Callable[[Remedy], str] | None = None) -> ConformalUVError | None:
        """One error for all charts where none was mapped, of their class where they have one; else None."""
        errors = list(self.charts.errors.values())
        if self.mapped.any() or not errors:
            return None
        if len(errors) == 1:
            return errors[0]
        kinds = {type(error) for error in errors}
        kind = kinds.pop() if len(kinds) == 1 else ConformalUVError
        return kind(self.told(words), [index for error in errors for index in error.indices])
