"""Where charts go in the texture: one fills it, several are packed by their outlines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..options import Place, PlaceOptions
from .outlines import Outlines, chart_outlines, disk_outlines
from .spacing import spacing_of
from .square_packing import pack_outlines

__all__ = ["ChartShape", "Placement", "Placements", "pack_charts", "pack_disks", "placements"]

Real = NDArray[np.float64]
ChartShape = tuple[NDArray[np.complex128], NDArray[np.integer]]

LEAST_FILL = 1e-3  # an image that fills less of its disk or box than this counts as filling that much


@dataclass(frozen=True)
class Placement:
    """A chart's place in the texture: ``uv = center + scale * exp(i angle) * (position in its own plane)``.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> from conformal_uv.samples import mask
    >>> cuv.unwrap(*mask(200), margin=0.1).charts[0].placement
    Placement(center=(0.5, 0.5), scale=0.4, angle=0.0)
    """

    center: tuple[float, float] = (0.0, 0.0)
    scale: float = 1.0
    angle: float = 0.0


class Placements(NamedTuple):
    """The places of k charts: centers (k,) complex128, scales (k,) and angles (k,)."""

    center: NDArray[np.complex128]
    scale: Real
    angle: Real

    @classmethod
    def untouched(cls, count: int) -> Placements:
        """Of charts that stay as they are in their own planes."""
        return cls(np.zeros(count, dtype=np.complex128), np.ones(count), np.zeros(count))

    def put(self, numbers: NDArray[np.generic], given: Placements) -> None:
        """Set those of some charts."""
        for own, new in zip(self, given, strict=True):
            own[numbers] = new

    def part(self, numbers: slice) -> Placements:
        """Those of some charts."""
        return Placements(self.center[numbers], self.scale[numbers], self.angle[numbers])

    def placed(self, z: NDArray[np.complex128], chart: NDArray[np.integer]) -> NDArray[np.complex128]:
        """Positions of charts in the texture."""
        factor = self.scale * np.where(self.angle == 0.0, 1.0, np.exp(1j * self.angle))
        return self.center[chart] + factor[chart] * z

    def moved(self, numbers: NDArray[np.int64]) -> bool:
        """Whether one of some charts is not where it is in its own plane."""
        here = (self.center == 0.0) & (self.scale == 1.0) & (self.angle == 0.0)
        return not here[numbers].all()

    def of(self, number: int) -> Placement:
        """The place of one of them."""
        center = self.center[number]
        return Placement((float(center.real), float(center.imag)), float(self.scale[number]), float(self.angle[number]))


def placements(
    options: PlaceOptions,
    area: Real,
    image_area: Real,
    charts: Sequence[ChartShape] | Outlines | None = None,
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
        Or their outlines: the charts in their planes; unit disks where none are given.
    """
    if options.place is Place.DISK or not len(area):
        return Placements.untouched(len(area))
    outlines = disk_outlines(np.ones(len(area))) if charts is None else _outlines(charts)
    full = np.pi if charts is None else outlines.size.real * outlines.size.imag
    least = np.maximum(image_area, LEAST_FILL * full)
    scale = np.sqrt(np.divide(area, least, out=np.zeros(len(area)), where=least > 0.0))
    if not scale.max() > 0.0:
        scale = np.ones(len(area))
    if charts is None and len(area) == 1:
        return _disk_alone(float(scale[0]), options)
    found = _in_square(outlines.scaled(scale), options)
    return Placements(found.center, scale * found.scale, found.angle)


def pack_charts(charts: Sequence[ChartShape] | Outlines, options: PlaceOptions | None = None) -> Placements:
    """Places of charts in the unit square, one scale for all; they do not overlap.

    Parameters
    ----------
    charts : sequence of positions (n,) complex and triangles (3, m)
        Each in a plane of its own, as large in relation to the others as it is to be. Other charts may come to lie in
        its bays and holes.
    """
    if not len(charts):
        return Placements.untouched(0)
    return _in_square(_outlines(charts), options or PlaceOptions())


def _outlines(charts: Sequence[ChartShape] | Outlines) -> Outlines:
    return charts if isinstance(charts, Outlines) else chart_outlines(charts)


def pack_disks(radius: Real, margin: float) -> tuple[Real, float]:
    """Centres (k, 2) in the unit square, and the factor by which all radii (k,) are multiplied.

    Disks keep at least `margin` from each other and from the square's sides.
    """
    found = _in_square(disk_outlines(radius), PlaceOptions(margin=margin))
    return np.column_stack((found.center.real, found.center.imag)), float(found.scale[0])


def _disk_alone(radius: float, options: PlaceOptions) -> Placements:
    """In the middle of the square, to the last digit."""
    spacing = spacing_of(disk_outlines(np.array([radius])), options)
    edge = spacing.at_sides * spacing.part
    scale = (0.5 - edge) / (1.0 + spacing.at_sides * spacing.length / radius)
    if options.keep_scale:
        scale = radius
    return Placements(np.array([0.5 + 0.5j + options.corner]), np.array([scale]), np.zeros(1))


def _in_square(outlines: Outlines, options: PlaceOptions) -> Placements:
    """Where the origins of the charts' planes come; one scale for all."""
    packed = pack_outlines(outlines, spacing_of(outlines, options), options.pack_rotation, options.pack_shape)
    scale = 1.0 if options.keep_scale else 1.0 / packed.side
    return Placements(packed.origin * scale + options.corner, np.full(len(outlines), scale), packed.angle)
