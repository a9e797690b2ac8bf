"""From polygons, seams and a selection to charts, or the reason why one can not be mapped."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ..errors import listed
from ..mesh.orientation import disagreeing_pairs, face_signs
from ..mesh.polygons import PolygonMesh
from ..options import NonManifold, Orientation, SplitOptions
from .boundary_loops import without_digons
from .cut_surface import CutSurface
from .faults import (
    Faults,
    by_chart,
    note_crowded_edges,
    note_pinched_vertices,
    note_unusable_polygons,
)
from .selected_part import SelectedPart, linked_charts, mesh_of, selected_part
from .winding import note_orientation, turned, untwisted

__all__ = ["Split", "split_into_charts"]

Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]


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
    across : (k,) int64
        The side across the same edge of the mesh, not minding seams; negative where there is none.
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
    across: Ints
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


def split_into_charts(whole: PolygonMesh, finite: Bools, selected: Ints, seams: Ints, options: SplitOptions) -> Split:
    """Cut the selected polygons apart along seams and wherever their sides are not joined in pairs.

    Raises
    ------
    OptionError
        A seam that is no edge of the mesh.
    """
    mesh, corner = mesh_of(whole, selected)
    part = selected_part(mesh, whole, seams)
    cut_crowds = options.nonmanifold is NonManifold.CUT
    count, chart = linked_charts(part, across_crowded=not cut_crowds)
    faults, notes = Faults(), dict[int, list[str]]()
    note_unusable_polygons(faults, part, finite, chart, selected)
    several = np.ones(len(whole.V), dtype=bool)  # vertices that may have several fans without being cut
    if not cut_crowds:
        note_crowded_edges(faults, part, chart, selected)
        several = note_pinched_vertices(faults, part, _used_elsewhere(whole, mesh), chart, selected)
    part, turn = _wound(part, chart, selected, options, faults, notes)
    surface = without_digons(_cut_open(part, chart, several), faults.sound(count))
    split = Split(count, selected, part.mesh, corner[turn], part.sides.twin, surface, faults, notes)
    if cut_crowds:
        _note_split_places(split, part)
    return split


def _used_elsewhere(whole: PolygonMesh, mesh: PolygonMesh) -> Bools:
    """Vertices that polygons of `whole` outside `mesh` use, (n,)."""
    n = len(whole.V)
    if len(whole.corners) == len(mesh.corners):
        return np.zeros(n, dtype=bool)
    return np.bincount(whole.corners, minlength=n) > np.bincount(mesh.corners, minlength=n)


def _wound(
    part: SelectedPart, chart: Ints, name: Ints, options: SplitOptions, faults: Faults, notes: dict[int, list[str]]
) -> tuple[SelectedPart, Ints]:
    """The polygons all wound one way in each chart, and the old corner of each corner."""
    same = np.arange(len(part.mesh.corners))
    if not len(disagreeing_pairs(part.mesh.corners, part.twin)):
        return part, same
    sign = face_signs(part.mesh.corners, part.sides.polygon, part.twin, len(part.mesh.sizes))
    if options.orientation is Orientation.REFUSE:
        note_orientation(faults, sign, chart, name)
        return part, same
    against = np.flatnonzero(sign < 0)
    for number, own in by_chart(name[against], chart[against]):
        notes.setdefault(number, []).append(f"{len(own)} faces wound against the rest were turned: faces {listed(own)}")
    for number in np.unique(chart[sign == 0]):
        notes.setdefault(int(number), []).append("one-sided: cut where the two windings meet")
    if (sign == 0).any():
        part, sign = untwisted(part, sign, chart)
    return turned(part, sign)


def _cut_open(part: SelectedPart, chart: Ints, several: Bools) -> CutSurface:
    """The surface with vertices split into their fans, those on the boundary and `several` (n,)."""
    corners, sides = part.mesh.corners, part.sides
    n = len(part.mesh.V)
    whole = CutSurface(
        part.mesh.V, corners, sides.follow, sides.polygon, part.twin, chart, corners, np.arange(n), len(chart)
    )
    return whole.with_twins(part.twin, several | whole.touching(np.flatnonzero(part.twin == -1)))


def _note_split_places(split: Split, part: SelectedPart) -> None:
    crowded = np.flatnonzero((part.sides.twin == -2) & ~part.seam[part.sides.edge])
    for number, own in by_chart(part.sides.edge[crowded], split.surface.chart[part.sides.polygon[crowded]]):
        split.add_note(number, f"cut along {len(np.unique(own))} edges of three or more faces")
