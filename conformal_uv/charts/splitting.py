"""From polygons, seams and a selection to charts that are disks, or the reason why one is not."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import listed
from ..mesh.orientation import disagreeing_pairs, face_signs
from ..mesh.polygons import PolygonMesh
from .boundaries import without_digons
from .cut_surface import CutSurface
from .disks import made_disks
from .faults import (
    Faults,
    by_chart,
    note_crowded_edges,
    note_pinched_vertices,
    note_unusable_polygons,
)
from .mending import Mending
from .seaming import SeamedMesh, linked_charts, seamed_mesh, selected_part
from .split import Split
from .winding import note_orientation, turned, untwisted

__all__ = ["split_into_charts"]

Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]


def split_into_charts(whole: PolygonMesh, finite: Bools, selected: Ints, seams: Ints, mending: Mending) -> Split:
    """Cut the selected polygons apart and each chart open; see `unwrap` for the options in `mending`.

    Raises
    ------
    OptionError
        A seam that is no edge of the mesh, an outer loop's vertex that is on no boundary.
    """
    part, corner = selected_part(whole, selected)
    seamed = seamed_mesh(part, whole, seams)
    cut_crowds = mending.nonmanifold == "cut"
    count, chart = linked_charts(seamed, across_crowded=not cut_crowds)
    faults, notes = Faults(), dict[int, list[str]]()
    note_unusable_polygons(faults, seamed, finite, chart, selected)
    several = np.ones(len(whole.V), dtype=bool)  # vertices that may have several fans without being cut
    if not cut_crowds:
        note_crowded_edges(faults, seamed, chart, selected)
        several = note_pinched_vertices(faults, seamed, _used_elsewhere(whole, part), chart, selected)
    seamed, turn = _wound(seamed, chart, selected, mending, faults, notes)
    surface = without_digons(_cut_open(seamed, chart, several), faults.sound(count))
    split = Split(count, selected, seamed.mesh, corner[turn], surface, faults, notes)
    if cut_crowds:
        _note_split_places(split, seamed)
    return made_disks(split, seamed.sides.twin, mending)


def _used_elsewhere(whole: PolygonMesh, part: PolygonMesh) -> Bools:
    """Vertices that polygons outside the part use, (n,)."""
    n = len(whole.V)
    if len(whole.corners) == len(part.corners):
        return np.zeros(n, dtype=bool)
    return np.bincount(whole.corners, minlength=n) > np.bincount(part.corners, minlength=n)


def _wound(
    seamed: SeamedMesh, chart: Ints, name: Ints, mending: Mending, faults: Faults, notes: dict[int, list[str]]
) -> tuple[SeamedMesh, Ints]:
    """The polygons all wound one way in each chart, and the old corner of each corner."""
    same = np.arange(len(seamed.mesh.corners))
    if not len(disagreeing_pairs(seamed.mesh.corners, seamed.twin)):
        return seamed, same
    sign = face_signs(seamed.mesh.corners, seamed.sides.polygon, seamed.twin, len(seamed.mesh.sizes))
    if mending.orientation == "refuse":
        note_orientation(faults, sign, chart, name)
        return seamed, same
    against = np.flatnonzero(sign < 0)
    for number, own in by_chart(name[against], chart[against]):
        notes.setdefault(number, []).append(f"{len(own)} faces wound against the rest were turned: faces {listed(own)}")
    for number in np.unique(chart[sign == 0]):
        notes.setdefault(int(number), []).append("one-sided: cut where the two windings meet")
    if (sign == 0).any():
        seamed, sign = untwisted(seamed, sign, chart)
    return turned(seamed, sign)


def _cut_open(seamed: SeamedMesh, chart: Ints, several: Bools) -> CutSurface:
    """The surface with vertices split into their fans, those on the boundary and `several` (n,)."""
    corners, sides = seamed.mesh.corners, seamed.sides
    n = len(seamed.mesh.V)
    whole = CutSurface(
        seamed.mesh.V, corners, sides.follow, sides.polygon, seamed.twin, chart, corners, np.arange(n), len(chart)
    )
    return whole.with_twins(seamed.twin, several | whole.touching(np.flatnonzero(seamed.twin == -1)))


def _note_split_places(split: Split, seamed: SeamedMesh) -> None:
    crowded = np.flatnonzero((seamed.sides.twin == -2) & ~seamed.seam[seamed.sides.edge])
    for number, own in by_chart(seamed.sides.edge[crowded], split.surface.chart[seamed.sides.polygon[crowded]]):
        split.add_note(number, f"cut along {len(np.unique(own))} edges of three or more faces")
