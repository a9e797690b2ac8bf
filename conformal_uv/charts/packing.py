"""Where the disks of the charts go in the texture: one fills it, several are packed.

The squares around them are packed by rpack (rectangle-packer), on a grid of whole cells.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import MissingDependencyError
from ..options import Place

__all__ = ["Placement", "kept_margin", "pack_disks", "placements"]

Real = NDArray[np.float64]

PACKED_MARGIN = 0.005  # between packed disks where no margin is asked for
LEAST_FILL = 1e-3  # an image that fills less of its disk than this counts as filling that much
MOST_CELLS, FEWEST_CELLS = 32, 4  # a typical disk is this many cells across
CELLS_FOR_ALL = 8000  # rpack's time grows with the number of rectangles and with their sizes
GROWTH = 1.02  # of the square's side from one try to the next


@dataclass(frozen=True)
class Placement:
    """A chart's disk in the texture: ``uv = center + scale * (position in the unit disk)``.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> from conformal_uv.samples import mask
    >>> cuv.unwrap(*mask(200), margin=0.1).charts[0].placement
    Placement(center=(0.5, 0.5), scale=0.4)
    """

    center: tuple[float, float] = (0.0, 0.0)
    scale: float = 1.0


def placements(place: Place, margin: float | None, area: Real, image_area: Real) -> list[Placement]:
    """A placement for each mapped chart.

    Parameters
    ----------
    area : (k,)
        Of each chart on the surface.
    image_area : (k,)
        Of its image in the unit disk. When charts are packed, scales are such that the ratio of the image's area
        to the surface's is the same for all.
    """
    if place is Place.DISK or not len(area):
        return [Placement()] * len(area)
    if len(area) == 1:
        return [Placement((0.5, 0.5), 0.5 - (margin or 0.0))]
    radius = np.sqrt(area / np.maximum(image_area, LEAST_FILL * np.pi))
    if not radius.max() > 0.0:
        radius = np.ones(len(area))
    centers, scale = pack_disks(radius, kept_margin(PACKED_MARGIN if margin is None else margin, len(area)))
    return [Placement((float(x), float(y)), float(r)) for (x, y), r in zip(centers, radius * scale, strict=True)]


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
