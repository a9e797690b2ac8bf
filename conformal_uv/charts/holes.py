"""Filling holes for the solution: slits of seams are closed again, other holes get a polygon of their own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .boundaries import Boundaries
from .cut_surface import CutSurface

__all__ = ["filled", "zipped"]

Ints = NDArray[np.int64]


def zipped(surface: CutSurface, found: Boundaries, inner: NDArray[np.bool_], partner: Ints) -> CutSurface:
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
    # Sides that can be joined: cut from each other, in one loop, running opposite ways.
    fits = (across >= 0) & (found.loop[across] == found.loop) & (tail[across] == head) & (head[across] == tail)
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


def filled(surface: CutSurface, found: Boundaries, inner: NDArray[np.bool_]) -> CutSurface:
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
