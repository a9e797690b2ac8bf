"""How far charts keep from each other and from the sides of the square."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..options import MarginMethod, PlaceOptions
from .outlines import Outlines

__all__ = ["Spacing", "kept_margin", "spacing_of"]

PACKED_MARGIN = 0.005  # between packed charts where no margin is asked for
OF_BOXES = 0.1  # Blender's factor to the sum of the boxes' sides for a margin that is scaled
LEAST = 1e-12  # of the side, against rounding
SLACK = 1.0 + 1e-9


@dataclass(frozen=True)
class Spacing:
    """Distances that depend on the square's side.

    Attributes
    ----------
    part : float
        What charts keep from each other, as a part of the side.
    length : float
        What is added to that, in the units of the charts.
    at_sides : float
        What they keep from the sides of the square, as a part of what they keep from each other.
    """

    part: float
    length: float = 0.0
    at_sides: float = 1.0

    def between(self, side: float) -> float:
        """Distance between charts in a square of this side."""
        return (self.part + LEAST) * SLACK * side + self.length

    def least_side(self, across: float) -> float:
        """Of the square that a chart so far across fills."""
        return (across + 2.0 * self.at_sides * self.length) / (1.0 - 2.0 * self.at_sides * (self.part + LEAST) * SLACK)


def kept_margin(margin: float, count: int) -> float:
    """The margin that `count` charts can keep: at most a quarter of a chart's share of the square's side."""
    return min(margin, 0.25 / max(1.0, np.ceil(np.sqrt(count))))


def spacing_of(outlines: Outlines, options: PlaceOptions) -> Spacing:
    """What the options ask for with these charts.

    Blender keeps its margin around every chart: twice that between two of them (`MarginMethod`).
    """
    count, margin, method = len(outlines), options.margin, options.margin_method
    if margin is None:
        margin, method = (PACKED_MARGIN if count > 1 else 0.0), MarginMethod.BETWEEN
    if method is MarginMethod.PIXELS:
        margin /= options.image_size
    if method is MarginMethod.SCALED:
        margin *= OF_BOXES * float(np.sqrt(outlines.size.real * outlines.size.imag).sum())
    if method in {MarginMethod.ADD, MarginMethod.SCALED}:
        return Spacing(0.0, 2.0 * margin, 0.5)
    around = method is not MarginMethod.BETWEEN
    part = 2.0 * margin if around else margin
    if options.keep_scale:  # the square's side is 1, whatever comes to lie beyond it
        return Spacing(0.0, part, 0.5 if around else 1.0)
    return Spacing(kept_margin(part, count) if count > 1 else part, 0.0, 0.5 if around else 1.0)
