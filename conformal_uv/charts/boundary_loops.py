"""Boundary loops of all charts at once: what they say about each chart's topology, and holes filled for the solution.

Slits of seams are closed again, other holes get a polygon of their own.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..mesh.loop_order import loop_order
from .cut_surface import CutSurface

__all__ = ["BoundaryLoops", "boundary_loops", "filled", "genera", "without_digons", "zipped"]

Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class BoundaryLoops:
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

    def outer_loops(self, count: int, vertices: Ints | None, surface: CutSurface) -> Ints:
        """The loop of each of `count` charts that becomes the circle, (count,); -1 where there is none.

        The loop through one of the `vertices`, else the longest, else the first.
        """
        through = np.zeros(len(self.length), dtype=bool)
        if vertices is not None:
            through[self.loop[np.isin(surface.vertex[self.side], vertices)]] = True
        order = np.lexsort((-np.arange(len(self.length)), self.length, through))
        outer = np.full(count, -1, dtype=np.int64)
        outer[self.chart_of_loop[order]] = order  # the last of several assignments stays
        return outer


def boundary_loops(surface: CutSurface, sound: NDArray[np.bool_]) -> BoundaryLoops:
    """Boundary loops of the charts that are `sound` (count,): manifold and consistently wound."""
    side = np.flatnonzero(surface.twin == -1)
    side = side[sound[surface.chart[surface.polygon[side]]]]
    leaving = np.full(len(surface.vertex_of_site), -1, dtype=np.int64)
    leaving[surface.site[side]] = np.arange(len(side))
    following = leaving[surface.site[surface.follow[side]]]
    loop, steps = loop_order(following)
    first = side[steps == 0]
    length = np.bincount(loop, surface.side_lengths(side), minlength=len(first)).astype(np.float64)
    return BoundaryLoops(side, following, loop, steps, surface.chart[surface.polygon[first]], length)


def without_digons(surface: CutSurface, sound: NDArray[np.bool_]) -> CutSurface:
    """The surface with loops of two sides closed: both run between the same two sites, so nothing is cut there.

    Such are seams of a single edge inside a chart, and two of the polygons at an edge of three.
    """
    found = boundary_loops(surface, sound)
    here = np.arange(len(found.side))
    pair = (found.following[found.following] == here) & (found.following != here)
    if not pair.any():
        return surface
    sides, others = found.side[pair], found.side[found.following[pair]]
    twin = surface.twin.copy()
    twin[sides] = others
    return surface.with_twins(twin, surface.touching(sides))


def genera(surface: CutSurface, found: BoundaryLoops, count: int) -> Ints:
    """Number of handles of each of `count` charts: chi = 2 - 2 genus - loops."""
    chart_of_corner = surface.chart[surface.polygon]
    chart_of_site = np.full(len(surface.vertex_of_site), -1, dtype=np.int64)
    chart_of_site[surface.site] = chart_of_corner
    sites = np.bincount(chart_of_site[chart_of_site >= 0], minlength=count)
    sides = np.bincount(chart_of_corner, minlength=count)
    free = np.bincount(chart_of_corner[surface.twin == -1], minlength=count)
    chi = sites - (sides + free) // 2 + np.bincount(surface.chart, minlength=count)
    return (2 - chi - np.bincount(found.chart_of_loop, minlength=count)) // 2


def zipped(surface: CutSurface, found: BoundaryLoops, inner: NDArray[np.bool_], partner: Ints) -> CutSurface:
    """Close slits: seams inside a chart that end there.

    Filling a slit with a polygon would tear it open; nothing is gained by that, since inner loops are not on the
    circle. From each tip on, a side is joined again to the side that it was cut from.

    Parameters
    ----------
    inner : (l,) bool
        The loops to be filled.
    partner : (k,)
        The side across the same edge of the mesh, not minding seams; negative where there is none.
    """
    place = np.full(len(surface.twin), -1, dtype=np.int64)
    place[found.side] = np.arange(len(found.side))
    across = partner[found.side]
    tail, head = surface.vertex[found.side], surface.vertex[surface.follow[found.side]]
    across = np.where(inner[found.loop] & (across >= 0), place[np.maximum(across, 0)], -1)
    # Sides that can be joined: cut from each other, running opposite ways. From a tip on they are in one loop.
    fits = (across >= 0) & (tail[across] == head) & (head[across] == tail)
    if not fits.any():
        return surface
    following, preceding = found.following.copy(), np.empty_like(found.following)
    preceding[following] = np.arange(len(following))
    closed = _closed_pairs(following, preceding, across, np.flatnonzero(fits & (following == across)), fits)
    if not len(closed):
        return surface
    twin = surface.twin.copy()
    twin[found.side[closed]] = found.side[across[closed]]
    return surface.with_twins(twin, surface.touching(found.side[closed]))


def _closed_pairs(following: Ints, preceding: Ints, across: Ints, tips: Ints, fits: NDArray[np.bool_]) -> Ints:
    """Links joined to the ones across them, tip after tip; `following` and `preceding` are used up."""
    closed = np.zeros(len(following), dtype=bool)
    waiting = tips.tolist()
    while waiting:
        tip = waiting.pop()
        end = across[tip]
        if closed[tip] or following[tip] != end:
            continue
        before, after = preceding[tip], following[end]
        closed[tip] = closed[end] = True
        following[before], preceding[after] = after, before
        if fits[before] and following[before] == across[before]:
            waiting.append(int(before))
    return np.flatnonzero(closed)


def filled(surface: CutSurface, found: BoundaryLoops, inner: NDArray[np.bool_]) -> CutSurface:
    """The surface with a polygon in every loop that is `inner` (l,), running against the loop."""
    at = np.flatnonzero(inner[found.loop])
    if not len(at):
        return surface
    at = at[np.lexsort((found.steps[at], found.loop[at]))]
    across, loop = found.side[at], found.loop[at]
    start = np.flatnonzero(found.steps[at] == 0)
    k, p = len(surface.twin), len(surface.chart)
    own = k + np.arange(len(at))
    follow = own + 1
    follow[np.append(start[1:], len(at)) - 1] = k + start
    head = surface.follow[across]
    twin = np.concatenate((surface.twin, across))
    twin[across] = own
    polygon = p + np.cumsum(found.steps[at] == 0) - 1
    return replace(
        surface,
        vertex=np.concatenate((surface.vertex, surface.vertex[head])),
        follow=np.concatenate((surface.follow, follow)),
        polygon=np.concatenate((surface.polygon, polygon)),
        twin=twin,
        chart=np.concatenate((surface.chart, found.chart_of_loop[loop[start]])),
        site=np.concatenate((surface.site, surface.site[head])),
    )
