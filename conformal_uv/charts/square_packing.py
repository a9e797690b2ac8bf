"""Charts packed into a square: large ones by outline, very many small ones on shelves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..options import PackRotation, PackShape
from .orientations import angles, hull
from .outline_packing import Packed, pack_by_outline
from .outlines import Outlines, chart_outlines
from .shelves import blocks_of_shelves, square_of_shelves
from .spacing import Spacing

__all__ = ["pack_outlines"]

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]

MOST_BY_OUTLINE = 1000  # charts for which outlines are packed, one by one
SMALL = 32  # that many in a row fill the square: charts less wide and high go on shelves where there are more
BLOCK = 4  # side of a block of shelves, in the largest of its charts
BLOCKS = 8  # at most about that many along the sides of a square of them
GROWTH = 1.01


def pack_outlines(
    outlines: Outlines,
    spacing: Spacing,
    rotation: PackRotation = PackRotation.NONE,
    shape: PackShape = PackShape.OUTLINE,
) -> Packed:
    """Charts in the least square that is found, none on another."""
    if not np.abs(outlines.size).max() > 0.0:
        outlines = replace(outlines, size=np.full(len(outlines), 1.0 + 1j))
        rotation = PackRotation.NONE
    turned = angles(outlines, rotation)
    if len(outlines) == 1:
        return _alone(outlines, spacing, turned[:, 0])
    flat = outlines.turned(turned[0]) if turned[0].any() else outlines
    best = _by_shelves(flat, spacing, turned[0])
    small = _small(flat.size)
    if small.all():
        return best
    found = _large_and_small(_seen(outlines, shape), flat, spacing, turned, small, best.side)
    return best if found is None else found


def _seen(outlines: Outlines, shape: PackShape) -> Outlines:
    """The charts as the packer is to see them."""
    if shape is PackShape.OUTLINE:
        return outlines
    if shape is PackShape.BOX:
        return outlines.boxes()
    rims = [hull(z + low) for z, low in zip(outlines.positions(), outlines.low, strict=True)]
    fans = [np.array([0 * k, k, k + 1]) for k in (np.arange(1, len(rim) - 1) for rim in rims)]
    return chart_outlines(list(zip(rims, fans, strict=True)))


def _alone(outlines: Outlines, spacing: Spacing, angle: Real) -> Packed:
    """One chart in the middle, turned so that it fills the square best."""
    ways = [outlines.turned(np.array([one])) if one else outlines for one in angle]
    across = [float(max(way.size.real[0], way.size.imag[0])) for way in ways]
    best = int(np.argmin(across))
    side = spacing.least_side(across[best])
    return Packed(angle[[best]], 0.5 * (side * (1 + 1j) - ways[best].size) - ways[best].low, side)


def _by_shelves(outlines: Outlines, spacing: Spacing, angle: Real) -> Packed:
    """All boxes on shelves; the side that the margin is a part of is found by trying."""
    size = outlines.size
    side = float(np.sqrt((size.real * size.imag).sum())) + float(np.abs(size).max())
    while True:
        gap = spacing.between(side)
        edge = spacing.at_sides * gap
        place, extent = square_of_shelves(size + gap * (1 + 1j))
        if extent - gap + 2.0 * edge <= side:
            return Packed(angle, place + edge * (1 + 1j) - outlines.low, side)
        side = GROWTH * (extent - gap + 2.0 * edge)


def _small(size: Complex) -> NDArray[np.bool_]:
    """Which charts go on shelves: none where all can be packed by outline."""
    if len(size) <= MOST_BY_OUTLINE:
        return np.zeros(len(size), dtype=bool)
    across = np.maximum(size.real, size.imag)
    limit = float(np.sqrt((size.real * size.imag).sum())) / SMALL
    small = across < limit
    small[np.argsort(-across, kind="stable")[MOST_BY_OUTLINE:]] = True
    return small


def _large_and_small(
    outlines: Outlines, flat: Outlines, spacing: Spacing, turned: Real, small: NDArray[np.bool_], enough: float
) -> Packed | None:
    """Large charts packed with blocks of small ones; None where no side less than `enough` is found."""
    if not small.any():
        return pack_by_outline(outlines, spacing, turned, enough)
    gap = spacing.between(enough) * (1 + 1j)
    size = flat.size[small] + gap
    side = max(BLOCK * size.real.max(), BLOCK * size.imag.max(), np.sqrt((size.real * size.imag).sum()) / BLOCKS)
    inside, block, around = blocks_of_shelves(size, float(side))
    straight = np.zeros((len(turned), len(around)))
    found = pack_by_outline(
        outlines.chosen(~small).with_boxes(around - gap),
        spacing,
        np.concatenate((turned[:, ~small], straight), axis=1),
        enough,
    )
    if found is None:
        return None
    angle, origin = turned[0].copy(), np.empty(len(outlines), dtype=np.complex128)
    count = len(outlines) - len(inside)
    angle[~small], origin[~small] = found.angle[:count], found.origin[:count]
    origin[small] = found.origin[count:][block] + inside - flat.low[small]
    return Packed(angle, origin, found.side)
