"""Where the disks of the charts go in the plane of the texture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..options import Place
from .packing import kept_margin, pack_disks

__all__ = ["Placement", "placements"]

Real = NDArray[np.float64]

PACKED_MARGIN = 0.005  # between packed disks where no margin is asked for
LEAST_FILL = 1e-3  # an image that fills less of its disk than this counts as filling that much


@dataclass(frozen=True)
class Placement:
    """A chart's disk in the texture: ``uv = center + scale * (position in the unit disk)``."""

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
