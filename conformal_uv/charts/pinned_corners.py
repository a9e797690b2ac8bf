"""Corners whose texture coordinates are given, as pins of the charts that they lie in."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import OptionError, listed
from .chart_meshes import ChartMeshes
from .splitting import Split

__all__ = ["ChartPins", "PinnedCorners", "pinned_corners"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]
ChartPins = tuple[Ints, Real]


class PinnedCorners:
    """The pins of all charts.

    Parameters
    ----------
    corners : (q,) int64
        The caller's corners, increasing.
    places : (q, 2) float64
    """

    def __init__(self, corners: Ints, places: Real, split: Split, meshes: ChartMeshes) -> None:
        caller = split.corner[meshes.corner].reshape(-1)
        at = np.minimum(np.searchsorted(corners, caller), max(len(corners) - 1, 0))
        hit = np.flatnonzero(corners[at] == caller) if len(corners) else at[:0]
        chart, vertex = np.repeat(meshes.chart_of_face, 3)[hit], meshes.F.reshape(-1)[hit]
        _, first = np.unique(np.column_stack((chart, vertex)), axis=0, return_index=True)  # vertices have many corners
        self._chart, self._vertex, self._place = chart[first], vertex[first], places[at[hit[first]]]
        self._count = len(meshes.area)

    @property
    def charts(self) -> NDArray[np.bool_]:
        """Charts with pins enough, (c,)."""
        apart = np.zeros(self._count, dtype=bool)
        if not len(self._chart):
            return apart
        leads = np.append(True, self._chart[1:] != self._chart[:-1])
        lead = np.flatnonzero(leads)[np.cumsum(leads) - 1]
        apart[self._chart[(self._place != self._place[lead]).any(axis=1)]] = True
        return apart

    def of_chart(self, number: int) -> ChartPins:
        """Vertices (p,) in the chart's own numbers, and their places (p, 2)."""
        own = self._chart == number
        return self._vertex[own], self._place[own]


def pinned_corners(given: Mapping[int, ArrayLike] | None, count: int) -> tuple[Ints, Real]:
    """Corners (q,), increasing, and their places (q, 2).

    Parameters
    ----------
    count : int
        How many corners there are.

    Raises
    ------
    OptionError
        Not corners of the mesh, or not finite places of two numbers.
    """
    if not given:
        return np.empty(0, dtype=np.int64), np.empty((0, 2))
    try:
        corners = np.array(list(given))
        places = np.array(list(given.values()), dtype=np.float64)
    except (AttributeError, TypeError, ValueError) as error:
        raise OptionError(f"pinned_uv is no mapping of corners to places ({error}).") from error
    if corners.dtype.kind not in "iu" or corners.ndim != 1 or places.shape != (len(corners), 2):
        raise OptionError("pinned_uv maps corners, whole numbers, to places of two numbers each.")
    bad = corners[(corners < 0) | (corners >= count) | ~np.isfinite(places).all(axis=1)]
    if len(bad):
        raise OptionError(f"pinned_uv: {listed(bad)} are no corners 0 .. {count - 1} with finite places.")
    order = np.argsort(corners)
    return corners[order].astype(np.int64), places[order]
