"""Which boundary vertices become the corners of a rectangle."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..errors import OptionError, TopologyError

__all__ = ["given_corners", "quarters", "require_four", "turning_corners"]

Real = NDArray[np.float64]
Ints = NDArray[np.int64]

WIDEST = 0.24  # of the boundary's length, that corners are kept apart at first; each scale has half of it
SCALES = 14
REACH = 0.25  # of that distance, over which turning is summed to either side
ENOUGH = 0.5  # of the turning at the weakest corner, for which a finer scale is not asked
ALIKE = 1e-3  # radians; of vertices that turn alike, the one farthest from the others


def given_corners(loop: Ints, corners: Sequence[int]) -> Ints:
    """Places in the loop of four vertices that follow each other in its direction.

    Raises
    ------
    OptionError
        They do not, or are not on the boundary.
    """
    place = [np.flatnonzero(loop == v) for v in corners]
    outside = [v for v, found in zip(corners, place, strict=True) if not len(found)]
    if outside:
        raise OptionError(f"Corners {outside} are not on the boundary; pass four boundary vertices.")
    at = np.array([int(found[0]) for found in place])
    if len(set(at.tolist())) < 4:
        raise OptionError(f"Corners {list(corners)} are not four different vertices.")
    after = (at - at[0]) % len(loop)
    if (np.diff(after) < 0).any():
        ordered = [corners[k] for k in np.argsort(after)]
        raise OptionError(
            f"Corners {list(corners)} do not follow each other in the boundary's direction; pass {ordered}."
        )
    return at


def require_four(loop: Ints) -> None:
    """Raise TopologyError where the boundary has too few vertices for a rectangle."""
    if len(loop) < 4:
        raise TopologyError(
            f"The boundary has {len(loop)} vertices; a rectangle has four corners. Subdivide the mesh.", loop
        )


def turning_corners(turning: Real, lengths: Real) -> Ints:
    """Places of the four vertices around which the boundary turns most, ascending.

    What turns at a vertex is summed over a stretch of boundary with weights that fall from it to the ends, so that a
    rounded corner is found in its middle, and to and fro cancels. Stretches and distances of corners are as wide as
    they may be: halved only where the weakest of the corners turns twice as much then.

    Parameters
    ----------
    turning : (nb,) float64
        Exterior angles, radians.
    lengths : (nb,) float64
        Of the boundary edge from each vertex to the next.
    """
    where = np.concatenate(([0.0], np.cumsum(lengths)[:-1])) / lengths.sum()
    chosen = []
    for scale in range(SCALES + 1):
        apart = WIDEST / 2.0**scale if scale < SCALES else 0.0
        score = _smoothed(turning, where, REACH * apart)
        corners = _apart(score, where, apart)
        if corners is not None:
            corners = _climbed(corners, score, where, REACH * apart)
            chosen.append((float(np.minimum(score[corners], 0.5 * np.pi).min()), corners))
    most = max(weakest for weakest, _ in chosen)
    return next(corners for weakest, corners in chosen if weakest >= min(ENOUGH * most, most))


def quarters(lengths: Real, first: float) -> Ints | None:
    """Places of the vertices nearest to quarters of the boundary's length, from this part of it on, ascending."""
    where = np.concatenate(([0.0], np.cumsum(lengths)[:-1])) / lengths.sum()
    wanted = (first + 0.25 * np.arange(4)) % 1.0
    corners = np.unique(_distance(where[:, None], wanted).argmin(axis=0))
    return corners if len(corners) == 4 else None


def _distance(one: Real, other: Real | float) -> Real:
    """Along a loop of length 1, the shorter way."""
    way = np.abs(one - other)
    return np.minimum(way, 1.0 - way)


def _smoothed(turning: Real, where: Real, reach: float) -> Real:
    """Sums with weights 1 - distance / reach of what lies within reach, on a loop of length 1."""
    if not reach > 0.0:
        return turning
    at = np.concatenate((where - 1.0, where, where + 1.0))
    around = np.tile(turning, 3)
    total, moment = (np.concatenate(([0.0], np.cumsum(x))) for x in (around, around * at))
    start, here, end = (np.searchsorted(at, where + shift) for shift in (-reach, 0.0, reach))
    before = (1.0 - where / reach) * (total[here] - total[start]) + (moment[here] - moment[start]) / reach
    after = (1.0 + where / reach) * (total[end] - total[here]) - (moment[end] - moment[here]) / reach
    return np.asarray(before + after)


def _apart(score: Real, where: Real, apart: float) -> Ints | None:
    """Four places of large scores, each so far from the others; None where there is no room for them."""
    chosen: list[int] = []
    room = np.full(len(score), np.inf)
    for _ in range(4):
        open_ = np.flatnonzero((room >= apart) & (room > 0.0))
        if not len(open_):
            return None
        best = open_[score[open_] >= score[open_].max() - (ALIKE if chosen else 0.0)]
        chosen.append(int(best[np.argmax(room[best])]))
        room = np.minimum(room, _distance(where, where[chosen[-1]]))
        room[chosen] = 0.0
    return np.sort(chosen)


def _climbed(corners: Ints, score: Real, where: Real, reach: float) -> Ints:
    """The places moved within reach to where the score is largest, as they would be but for the room of others."""
    near = _distance(where[corners][:, None], where) <= reach
    best = np.where(near, score, -np.inf).argmax(axis=1)
    moved = np.where(score[best] > score[corners] + ALIKE, best, corners)
    return np.sort(moved) if len(np.unique(moved)) == 4 else corners
