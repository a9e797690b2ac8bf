"""Charts packed into a square: large ones by outline, very many small ones on shelves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..errors import MissingDependencyError
from .box_packing import pack_by_box
from .outline_packing import pack_by_outline
from .outlines import Outlines
from .shelves import blocks_of_shelves, square_of_shelves

__all__ = ["pack_outlines"]

Complex = NDArray[np.complex128]
Packer = Callable[[Outlines, float, float], tuple[Complex, float] | None]

LEAST_MARGIN = 1e-12  # against rounding
SLACK = 1e-9
MOST_BY_OUTLINE = 400  # charts for which outlines are packed, one by one
SMALL = 32  # that many in a row fill the square: charts less wide and high go on shelves where there are more
BLOCK = 4  # side of a block of shelves, in the largest of its charts
BLOCKS = 8  # at most about that many along the sides of a square of them
GROWTH = 1.01


def pack_outlines(outlines: Outlines, margin: float) -> tuple[Complex, float]:
    """Where the corners of the charts' boxes come (k,), and the side of the square.

    Charts keep `margin` times the side from each other and from the square's sides.

    Raises
    ------
    MissingDependencyError
        There are several, and rectangle-packer is not installed.
    """
    margin = (margin + LEAST_MARGIN) * (1.0 + SLACK)
    if not np.abs(outlines.size).max() > 0.0:
        outlines = replace(outlines, size=np.full(len(outlines), 1.0 + 1j))
    if len(outlines) == 1:
        return _alone(outlines.size, margin)
    packer = _packer()
    best = _by_shelves(outlines.size, margin)
    small = _small(outlines.size)
    if small.all():
        return best
    found = _large_and_small(packer, outlines, small, margin, best[1])
    return best if found is None else found


def _alone(size: Complex, margin: float) -> tuple[Complex, float]:
    side = max(float(size.real[0]), float(size.imag[0])) / (1.0 - 2.0 * margin)
    return 0.5 * (side * (1 + 1j) - size), side


def _packer() -> Packer:
    """By boxes, and then by outlines where these take less room."""
    try:
        import rpack
    except ImportError as error:
        raise MissingDependencyError(
            'Packing several charts needs rectangle-packer: pip install rectangle-packer, or pass place="disk".'
        ) from error

    def packer(outlines: Outlines, margin: float, enough: float) -> tuple[Complex, float] | None:
        boxes = pack_by_box(rpack, outlines.size, margin, enough)
        found = pack_by_outline(outlines, margin, enough if boxes is None else boxes[1])
        return boxes if found is None else found

    return packer


def _by_shelves(size: Complex, margin: float) -> tuple[Complex, float]:
    """All boxes on shelves; the side that the margin is a part of is found by trying."""
    side = float(np.sqrt((size.real * size.imag).sum())) + float(np.abs(size).max())
    while True:
        gap = margin * side
        place, extent = square_of_shelves(size + gap * (1 + 1j))
        if extent + gap <= side:
            return place + gap * (1 + 1j), side
        side = GROWTH * (extent + gap)


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
    packer: Packer, outlines: Outlines, small: NDArray[np.bool_], margin: float, enough: float
) -> tuple[Complex, float] | None:
    """Large charts packed with blocks of small ones; None where no side less than `enough` is found."""
    if not small.any():
        return packer(outlines, margin, enough)
    gap = margin * enough * (1 + 1j)
    size = outlines.size[small] + gap
    side = max(BLOCK * size.real.max(), BLOCK * size.imag.max(), np.sqrt((size.real * size.imag).sum()) / BLOCKS)
    inside, block, around = blocks_of_shelves(size, float(side))
    found = packer(outlines.chosen(~small).with_boxes(around - gap), margin, enough)
    if found is None:
        return None
    place = np.empty(len(outlines), dtype=np.complex128)
    count = len(outlines) - len(inside)
    place[~small] = found[0][:count]
    place[small] = found[0][count:][block] + inside
    return place, found[1]
