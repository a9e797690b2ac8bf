"""Boundary loops of all charts at once, and what they say about each chart's topology."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..mesh.loop_order import loop_order
from .cut_surface import CutSurface

__all__ = ["Boundaries", "boundaries", "genera", "without_digons"]

Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Boundaries:
    """Boundary loops, each in the direction of its polygons.

    Attributes
    ----------
    side : (b,) int64
        The sides on the boundary; the arrays below run beside it.
    following : (b,) int64
        Place in `side` of the next one along the loop.
    loop : (b,) int64
    steps : (b,) int64
        Steps from each side to the first of its loop.
    chart_of_loop : (l,) int64
    length : (l,) float64
    """

    side: Ints
    following: Ints
    loop: Ints
    steps: Ints
    chart_of_loop: Ints
    length: NDArray[np.float64]

    def outer_loops(self, count: int, vertices: Ints, surface: CutSurface) -> Ints:
        """The loop of each of `count` charts that becomes the circle, (count,); -1 where there is none.

        The loop through one of the `vertices`, else the longest, else the first.
        """
        through = np.zeros(len(self.length), dtype=bool)
        through[self.loop[np.isin(surface.vertex[self.side], vertices)]] = True
        order = np.lexsort((-np.arange(len(self.length)), self.length, through))
        outer = np.full(count, -1, dtype=np.int64)
        outer[self.chart_of_loop[order]] = order  # the last of several assignments stays
        return outer


def boundaries(surface: CutSurface, sound: NDArray[np.bool_]) -> Boundaries:
    """Boundary loops of the charts that are `sound` (count,): manifold and consistently wound."""
    side = np.flatnonzero(surface.twin == -1)
    side = side[sound[surface.chart[surface.polygon[side]]]]
    leaving = np.full(len(surface.vertex_of_site), -1, dtype=np.int64)
    leaving[surface.site[side]] = np.arange(len(side))
    following = leaving[surface.site[surface.follow[side]]]
    loop, steps = loop_order(following)
    first = side[steps == 0]
    length = np.bincount(loop, surface.side_lengths(side), minlength=len(first)).astype(np.float64)
    return Boundaries(side, following, loop, steps, surface.chart[surface.polygon[first]], length)


def without_digons(surface: CutSurface, sound: NDArray[np.bool_]) -> CutSurface:
    """The surface with loops of two sides closed: both run between the same two sites, so nothing is cut there.

    Such are seams of a single edge inside a chart, and two of the polygons at an edge of three.
    """
    found = boundaries(surface, sound)
    here = np.arange(len(found.side))
    pair = (found.following[found.following] == here) & (found.following != here)
    if not pair.any():
        return surface
    sides, others = found.side[pair], found.side[found.following[pair]]
    twin = surface.twin.copy()
    twin[sides] = others
    return surface.with_twins(twin, surface.touching(sides))


def genera(surface: CutSurface, found: Boundaries, count: int) -> Ints:
    """Number of handles of each of `count` charts: chi = 2 - 2 genus - loops."""
    chart_of_corner = surface.chart[surface.polygon]
    chart_of_site = np.full(len(surface.vertex_of_site), -1, dtype=np.int64)
    chart_of_site[surface.site] = chart_of_corner
    sites = np.bincount(chart_of_site[chart_of_site >= 0], minlength=count)
    sides = np.bincount(chart_of_corner, minlength=count)
    free = np.bincount(chart_of_corner[surface.twin == -1], minlength=count)
    chi = sites - (sides + free) // 2 + np.bincount(surface.chart, minlength=count)
    return (2 - chi - np.bincount(found.chart_of_loop, minlength=count)) // 2
