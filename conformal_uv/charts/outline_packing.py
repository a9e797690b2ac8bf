"""Charts packed by their outlines into the least square that is found."""

from __future__ import annotations

from dataclasses import dataclass, replace

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
MANY = 400  # charts, up to which the opposite corner is tried, too, and a finer grid where none is turned
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


@dataclass(frozen=True)
class _Pass:
    """One try: its part of the cells, the ways of turning, the corner and the order in which charts are placed."""

    part: float
    angles: Real
    from_far: bool = False
    longest_first: bool = False


def pack_by_outline(outlines: Outlines, spacing: Spacing, angles: Real, enough: float) -> Packed | None:
    """Charts that are turned in one of several ways each, (ways, k); None where no side below `enough` is found."""
    best, of_best = None, None
    for one in _passes(angles):
        found = _packed(outlines, one, spacing, enough)
        if found is not None and found.side < enough:
            best, of_best, enough = found, one, found.side
    few = len(angles) > 1 or angles.shape[1] <= MANY
    if best is not None and of_best is not None and few:
        fine = replace(of_best, part=FINE, angles=best.angle[None])
        found = _packed(outlines, fine, spacing, enough)
        best = best if found is None or found.side >= enough else found
    return best


def _passes(angles: Real) -> list[_Pass]:
    """In turn."""
    ways, count = angles.shape
    first = angles[:FIRST_WAYS]
    passes = [_Pass(COARSE, first)]
    if count > FEW:
        passes += [_Pass(1.0, first)]
        passes += [_Pass(1.0, first, from_far=True)] if count <= MANY else []
        return passes + ([_Pass(1.0, angles)] if ways > FIRST_WAYS else [])
    passes += [_Pass(1.0, angles), _Pass(1.0, angles, from_far=True)]
    return passes + ([_Pass(1.0, angles, longest_first=True)] if ways == 1 else [])


def _cells(outlines: Outlines, ways: int, side: float, part: float) -> int:
    """Along the side of the square, or this part of them."""
    cells = part * float(np.clip(CELLS_OF_CHART * np.sqrt(len(outlines)), FEWEST_CELLS, MOST_CELLS))
    rows = ways * float(outlines.size.imag.sum()) / side  # a lookup takes an eighth of the cells, and a row takes two
    return int(max(COARSEST, min(cells, (4.0 * MOST_LOOKUPS / max(rows, 1.0)) ** (1.0 / 3.0))))


def _packed(outlines: Outlines, one: _Pass, spacing: Spacing, enough: float) -> Packed | None:
    """The same on one grid; from the far corner: all turned by half a turn, there and back."""
    cell = enough / _cells(outlines, len(one.angles), enough, one.part)
    angles = one.angles + HALF_TURN if one.from_far else one.angles
    ways = [outlines.turned(angle) if angle.any() else outlines for angle in angles]
    gap = spacing.between(enough)
    edge = spacing.at_sides * gap
    found = [stencils(footprints(way, cell, 0.5 * gap / cell)) for way in ways]
    places = pack_cells(found, int((enough - 2.0 * edge + gap) / cell), one.longest_first)
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
    if one.from_far:
        return Packed(angle - HALF_TURN, across + 1j * up - origin, side)
    return Packed(angle, origin, side)
