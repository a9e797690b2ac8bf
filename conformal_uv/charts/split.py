"""The selected polygons cut into charts."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ..mesh.polygons import PolygonMesh
from .cut_surface import CutSurface
from .faults import Faults

__all__ = ["Split"]

Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Split:
    """Charts of the selected polygons.

    Attributes
    ----------
    count : int
        Number of charts.
    selected : (q,) int64
        The caller's polygons in use; "polygon" below is a place in this list.
    mesh : PolygonMesh
        Those polygons, wound for the solution.
    corner : (k,) int64
        The caller's corner that each corner of `mesh` is.
    surface : CutSurface
        Its first corners are those of `mesh`; polygons that fill holes come after.
    faults : Faults
        The error of each chart that can not be mapped.
    notes : dict of lists of str
        What was mended, cut or filled in each chart.
    """

    count: int
    selected: Ints
    mesh: PolygonMesh
    corner: Ints
    surface: CutSurface
    faults: Faults
    notes: dict[int, list[str]] = field(default_factory=dict)

    def add_note(self, chart: int, text: str) -> None:
        """Append to the notes of a chart."""
        self.notes.setdefault(chart, []).append(text)

    def with_surface(self, surface: CutSurface) -> Split:
        """The same charts on a surface joined or cut otherwise."""
        return replace(self, surface=surface)

    @property
    def sound(self) -> NDArray[np.bool_]:
        """Which charts have no error so far, (count,)."""
        return self.faults.sound(self.count)
