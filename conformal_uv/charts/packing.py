"""Disks of given radii packed into the unit square.

The squares around them are packed by rpack (rectangle-packer), on a grid of whole cells.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import MissingDependencyError

__all__ = ["kept_margin", "pack_disks"]

Real = NDArray[np.float64]

MOST_CELLS, FEWEST_CELLS = 32, 4  # a typical disk is this many cells across
CELLS_FOR_ALL = 8000  # rpack's time grows with the number of rectangles and with their sizes
GROWTH = 1.02  # of the square's side from one try to the next


def kept_margin(margin: float, count: int) -> float:
    """The margin that `count` disks can keep: at most a quarter of a disk's share of the square's side."""
    return min(margin, 0.25 / max(1.0, np.ceil(np.sqrt(count))))


def pack_disks(radius: Real, margin: float) -> tuple[Real, float]:
    """Centres (k, 2) in the unit square, and the factor by which all radii (k,) are multiplied.

    Disks keep at least `margin` from each other and from the square's sides.

    Raises
    ------
    MissingDependencyError
        rectangle-packer is not installed.
    """
    try:
        import rpack
    except ImportError as error:
        raise MissingDependencyError(
            'Packing several charts needs rectangle-packer: pip install rectangle-packer, or pass place="disk".'
        ) from error
    across = 2.0 * radius
    typical = float(np.sqrt(np.mean(across**2)))
    cells = np.clip(CELLS_FOR_ALL // len(radius), FEWEST_CELLS, MOST_CELLS)
    across = across * (float(cells) / typical)
    share = margin / (1.0 - margin)
    side = max(float(np.sqrt((across**2).sum())), float(across.max()))
    while True:
        side = float(np.ceil(side * GROWTH))
        pad = share * side
        size = np.maximum(np.ceil(across + pad), 1.0).astype(np.int64)
        if size.max() > side or (size**2).sum() > side * side:
            continue
        try:
            corner = rpack.pack([(s, s) for s in size.tolist()], max_width=int(side), max_height=int(side))
            break
        except rpack.PackingImpossibleError:
            continue
    place = np.asarray(corner, dtype=np.float64) + 0.5 * size[:, None]
    extent = float((place + 0.5 * size[:, None]).max())
    unit = 1.0 / (extent + pad)
    return (place + 0.5 * pad) * unit, unit * float(cells) / typical
