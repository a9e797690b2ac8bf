"""Charts packed by their outlines into the least square that is found."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .cell_packing import pack_cells, stencils
from .footprints import footprints
from .outlines import Outlines
from .spacing import Spacing

__all__ = ["Packed", "pack_by_outline"]

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]

CELLS_OF_CHART = 20  # across one, where all are alike
FEWEST_CELLS, MOST_CELLS = 512, 640  # along the square's side
COARSE, FINE = 0.5, 2.0  # of these cells: to know the side that margins are a part of, and once ways are chosen
MOST_LOOKUPS = 1e10  # bytes looked at; long thin charts are packed on coarser grids
COARSEST = 96
FIRST_WAYS = 4  # the quarter turns
FEW = 64  # charts, of which all ways are tried from the first
MANY = 400  # charts, up to which the opposite corner is tried, too
HALF_TURN = np.pi


@dataclass(frozen=True, eq=False)
class Packed:
    """Charts in a square.

    Attributes
    ----------
    angle : (k,) float64
        By which each is turned about the origin of its plane.
    origin : (k,) complex128
        Where this origin comes to lie.
    side : float
        Of the square.
    """

    angle: Real
    origin: Complex
    side: float


def pack_by_outline(outlines: Outlines, spacing: Spacing, angles: Real, enough: float) -> Packed | None:
    """Charts that are turned in one of several ways each, (ways, k); None where no side below `enough` is found."""
    best, from_far = None, False
    for part, given, far in _passes(angles):
        found = _packed(outlines, given, spacing, enough, enough / _cells(outlines, len(given), enough, part), far)
        if found is not None and found.side < enough:
            best, enough, from_far = found, found.side, far
    if best is not None and len(angles) > 1:
        fine = enough / _cells(outlines, 1, enough, FINE)
        found = _packed(outlines, best.angle[None], spacing, enough, fine, from_far)
        best = best if found is None or found.side >= enough else found
    return best


def _passes(angles: Real) -> list[tuple[float, Real, bool]]:
    """Part of the cells, ways, and whether charts grow from the far corner: in turn."""
    ways, count = angles.shape
    first = angles[:FIRST_WAYS]
    if count <= FEW:
        return [(COARSE, first, False), (1.0, angles, False), (1.0, angles, True)]
    passes = [(COARSE, first, False), (1.0, first, False)]
    if count <= MANY:
        passes += [(1.0, first, True)]
    if ways > FIRST_WAYS:
        passes += [(1.0, angles, False)]
    return passes


def _cells(outlines: Outlines, ways: int, side: float, part: float) -> int:
    """Along the side of the square, or this part of them."""
    cells = part * float(np.clip(CELLS_OF_CHART * np.sqrt(len(outlines)), FEWEST_CELLS, MOST_CELLS))
    rows = ways * float(outlines.size.imag.sum()) / side  # a lookup takes an eighth of the cells, and a row takes two
    return int(max(COARSEST, min(cells, (4.0 * MOST_LOOKUPS / max(rows, 1.0)) ** (1.0 / 3.0))))


def _packed(
    outlines: Outlines, angles: Real, spacing: Spacing, enough: float, cell: float, from_far: bool
) -> Packed | None:
    """The same on one grid; from the far corner: all turned by half a turn, there and back."""
    angles = angles + HALF_TURN if from_far else angles
    ways = [outlines.turned(angle) if angle.any() else outlines for angle in angles]
    gap = spacing.between(enough)
    edge = spacing.at_sides * gap
    found = [stencils(footprints(way, cell, 0.5 * gap / cell)) for way in ways]
    places = pack_cells(found, int((enough - 2.0 * edge + gap) / cell))
    if places is None:
        return None
    chart = np.arange(len(places.way))
    low = np.stack([way.low for way in ways])[places.way, chart]
    size = np.stack([way.size for way in ways])[places.way, chart]
    corner = cell * (places.column + 1j * places.row)
    corner -= corner.real.min() + 1j * corner.imag.min()
    origin, far = corner + edge * (1.0 + 1j) - low, corner + size
    across, up = far.real.max() + 2.0 * edge, far.imag.max() + 2.0 * edge
    angle, side = angles[places.way, chart], float(max(across, up))
    if from_far:
        return Packed(angle - HALF_TURN, across + 1j * up - origin, side)
    return Packed(angle, origin, side)
