"""Where charts go in the texture: one fills it, several are packed by their outlines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..options import Place
from .outlines import Outlines, chart_outlines, disk_outlines
from .square_packing import pack_outlines

__all__ = ["Placement", "Placements", "kept_margin", "pack_charts", "pack_disks", "placements"]

Real = NDArray[np.float64]
ChartShape = tuple[NDArray[np.complex128], NDArray[np.integer]]

PACKED_MARGIN = 0.005  # between packed charts where no margin is asked for
LEAST_FILL = 1e-3  # an image that fills less of its disk or box than this counts as filling that much


@dataclass(frozen=True)
class Placement:
    """A chart's place in the texture: ``uv = center + scale * (position in its own plane)``.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> from conformal_uv.samples import mask
    >>> cuv.unwrap(*mask(200), margin=0.1).charts[0].placement
    Placement(center=(0.5, 0.5), scale=0.4)
    """

    center: tuple[float, float] = (0.0, 0.0)
    scale: float = 1.0


class Placements(NamedTuple):
    """The places of k charts: centers (k,) complex128 and scales (k,)."""

    center: NDArray[np.complex128]
    scale: Real

    @classmethod
    def untouched(cls, count: int) -> Placements:
        """Of charts that stay as they are in their own planes."""
        return cls(np.zeros(count, dtype=np.complex128), np.ones(count))

    def moved(self, numbers: NDArray[np.int64]) -> bool:
        """Whether one of some charts is not where it is in its own plane."""
        return bool((self.center[numbers] != 0.0).any() or (self.scale[numbers] != 1.0).any())

    def of(self, number: int) -> Placement:
        """The place of one of them."""
        center = self.center[number]
        return Placement((float(center.real), float(center.imag)), float(self.scale[number]))


def placements(
    place: Place,
    margin: float | None,
    area: Real,
    image_area: Real,
    charts: Sequence[ChartShape] | None = None,
) -> Placements:
    """A placement for each mapped chart.

    Parameters
    ----------
    area : (k,)
        Of each chart on the surface.
    image_area : (k,)
        Of its image in its own plane. When charts are packed, scales are such that the ratio of the image's area
        to the surface's is the same for all.
    charts : sequence of positions (n,) complex and triangles (3, m), optional
        The charts in their planes; unit disks where none are given.
    """
    if place is Place.DISK or not len(area):
        return Placements.untouched(len(area))
    if charts is None and len(area) == 1:
        return Placements(np.array([0.5 + 0.5j]), np.array([0.5 - (margin or 0.0)]))
    outlines = disk_outlines(np.ones(len(area))) if charts is None else chart_outlines(charts)
    full = np.pi if charts is None else outlines.size.real * outlines.size.imag
    least = np.maximum(image_area, LEAST_FILL * full)
    scale = np.sqrt(np.divide(area, least, out=np.zeros(len(area)), where=least > 0.0))
    if not scale.max() > 0.0:
        scale = np.ones(len(area))
    center, common = _in_unit_square(outlines.scaled(scale), margin)
    return Placements(center, scale * common)


def pack_charts(charts: Sequence[ChartShape], margin: float | None = None) -> list[Placement]:
    """Places of charts in the unit square, one scale for all; they are not turned and do not overlap.

    Parameters
    ----------
    charts : sequence of positions (n,) complex and triangles (3, m)
        Each in a plane of its own, as large in relation to the others as it is to be. Other charts may come to lie in
        its bays, not in its holes.
    margin : float, optional
        Kept between charts and to the square's sides, a part of its side; less where charts are too many for it.

    Raises
    ------
    MissingDependencyError
        There are several, and rectangle-packer is not installed.
    """
    if not len(charts):
        return []
    center, scale = _in_unit_square(chart_outlines(charts), margin)
    found = Placements(center, np.full(len(center), scale))
    return [found.of(number) for number in range(len(center))]


def pack_disks(radius: Real, margin: float) -> tuple[Real, float]:
    """Centres (k, 2) in the unit square, and the factor by which all radii (k,) are multiplied.

    Disks keep at least `margin` from each other and from the square's sides. Raises as `pack_charts`.
    """
    center, scale = _in_unit_square(disk_outlines(radius), margin)
    return np.column_stack((center.real, center.imag)), scale


def kept_margin(margin: float, count: int) -> float:
    """The margin that `count` charts can keep: at most a quarter of a chart's share of the square's side."""
    return min(margin, 0.25 / max(1.0, np.ceil(np.sqrt(count))))


def _in_unit_square(outlines: Outlines, margin: float | None) -> tuple[NDArray[np.complex128], float]:
    """Where the origins of the charts' planes come (k,), and their scale."""
    if len(outlines) > 1:
        margin = kept_margin(PACKED_MARGIN if margin is None else margin, len(outlines))
    place, side = pack_outlines(outlines, margin or 0.0)
    return (place - outlines.low) / side, 1.0 / side
