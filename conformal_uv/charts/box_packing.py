"""Charts packed by the boxes around them, by rpack (rectangle-packer), on a grid of whole cells."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["pack_by_box"]

Complex = NDArray[np.complex128]

MOST_CELLS, FEWEST_CELLS = 32, 4  # a typical box is this many cells across
CELLS_FOR_ALL = 8000  # rpack's time grows with the number of rectangles and with their sizes
TRIES = 3
GROWTH = 1.02  # of the square's side from one try to the next


def pack_by_box(rpack: Any, size: Complex, margin: float, enough: float) -> tuple[Complex, float] | None:
    """Where the lower left corners of boxes come (k,), and the side of the square around them.

    Boxes keep `margin` times the side from each other and from the square's sides. None where no side less than
    `enough` is found.
    """
    best = None
    for _ in range(TRIES):  # what is less wide needs less between
        found = _packed(rpack, size, margin * enough, enough)
        if found is None:
            break
        best, enough = found, found[1]
    return best


def _packed(rpack: Any, size: Complex, gap: float, enough: float) -> tuple[Complex, float] | None:
    """The same with a given gap."""
    typical = float(np.sqrt(np.mean(np.abs(size) ** 2 / 2.0)))
    cell = typical / float(np.clip(CELLS_FOR_ALL // len(size), FEWEST_CELLS, MOST_CELLS))
    width, height = (np.maximum(np.ceil((a + gap) / cell), 1.0).astype(np.int64) for a in (size.real, size.imag))
    side = max(np.sqrt(float((width * height).sum())), float(max(width.max(), height.max())))
    while (side := np.ceil(side)) * cell + gap < enough:
        try:
            boxes = list(zip(width.tolist(), height.tolist(), strict=True))
            corner = np.asarray(rpack.pack(boxes, max_width=int(side), max_height=int(side)), dtype=np.float64)
            place = corner[:, 0] + 1j * corner[:, 1]
            extent = max((place.real + width).max(), (place.imag + height).max())
            return cell * place + gap * (1 + 1j), cell * float(extent) + gap
        except rpack.PackingImpossibleError:
            side *= GROWTH
    return None
