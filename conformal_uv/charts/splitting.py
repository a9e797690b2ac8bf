"""From polygons, seams and a selection to charts that are disks, or the reason why one is not."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..errors import TopologyError, listed
from ..mesh.polygons import PolygonMesh
from .boundaries import Boundaries, boundaries, genera, without_digons
from .cut_graph import OneChart, handle_cut, sphere_cut
from .cut_surface import CutSurface
from .faults import (
    Faults,
    by_chart,
    note_crowded_edges,
    note_pinched_vertices,
    note_unusable_polygons,
)
from .holes import filled, zipped
from .mending import Mending
from .seaming import SeamedMesh, linked_charts, seamed_mesh, selected_part
from .winding import disagreements, note_orientation, polygon_signs, turned, untwisted

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
    return _made_disks(split, seamed.sides.twin, mending)


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
    if not len(disagreements(seamed)):
        return seamed, same
    sign = polygon_signs(seamed)
    if mending.orientation == "refuse":
        note_orientation(faults, sign, chart, name)
        return seamed, same
    against = np.flatnonzero(sign < 0)
    for number, own in by_chart(name[against], chart[against]):
        notes.setdefault(number, []).append(
            f"{len(own)} faces wound against the rest were turned: faces {listed(own)}"
        )
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


def _made_disks(split: Split, partner: Ints, mending: Mending) -> Split:
    """Choose the outer loops, fill the holes, cut closed charts and handles, or note why that is refused."""
    surface, sound = split.surface, split.faults.sound(split.count)
    found = boundaries(surface, sound)
    faulty = surface.vertex[~sound[surface.chart[surface.polygon]]]
    mending.check_outer_loop(np.concatenate((surface.vertex[found.side], faulty)))
    inner = _inner_loops(split, found, mending)
    if inner.any() and mending.holes == "refuse":
        _refuse_holes(split, found, inner)
    elif inner.any():
        surface = without_digons(zipped(split.surface, found, inner, partner), sound)
        if surface is not split.surface:
            changed = split.surface.polygon[np.flatnonzero(surface.twin != split.surface.twin)]
            for number in np.unique(split.surface.chart[changed]):
                split.add_note(int(number), "seams that end inside the chart were closed")
            split = _with_surface(split, surface)
            found = boundaries(surface, split.faults.sound(split.count))
            inner = _inner_loops(split, found, mending)
        for number, holes in enumerate(np.bincount(found.chart_of_loop[inner], minlength=split.count).tolist()):
            if holes:
                split.add_note(number, f"{holes} hole{'s' * (holes > 1)} filled for the solution")
        split = _with_surface(split, filled(split.surface, found, inner))
    return _cut_to_disks(split, mending)


def _with_surface(split: Split, surface: CutSurface) -> Split:
    return Split(split.count, split.selected, split.mesh, split.corner, surface, split.faults, split.notes)


def _inner_loops(split: Split, found: Boundaries, mending: Mending) -> Bools:
    outer = found.outer_loops(split.count, mending.outer_loop, split.surface)
    inner = np.ones(len(found.length), dtype=bool)
    inner[outer[outer >= 0]] = False
    return inner


def _refuse_holes(split: Split, found: Boundaries, inner: Bools) -> None:
    loops = np.flatnonzero(np.isin(found.chart_of_loop, found.chart_of_loop[inner]))
    first = split.surface.vertex[found.side[found.steps == 0]]
    edges = np.bincount(found.loop, minlength=len(inner))

    def tell(own: Ints) -> TopologyError:
        told = ", ".join(f"{edges[i]} edges at vertex {first[i]}" for i in own[:8])
        return TopologyError(
            f"The chart has {len(own)} boundary loops ({told}{', ...' if len(own) > 8 else ''}); a disk has one. "
            'Fill the holes, mark a seam between them, or pass holes="fill".',
            first[own],
        )

    split.faults.note(loops, found.chart_of_loop[loops], tell)


def _cut_to_disks(split: Split, mending: Mending) -> Split:
    """Open closed charts and handles."""
    sound = split.faults.sound(split.count)
    found = boundaries(split.surface, sound)
    genus = genera(split.surface, found, split.count)
    closed = np.bincount(found.chart_of_loop, minlength=split.count) == 0
    wanting = np.flatnonzero(sound & (closed | (genus > 0)))
    if not len(wanting):
        return split
    if mending.closed == "refuse":
        for number in wanting.tolist():
            split.faults[number] = _closed_error(bool(closed[number]), int(genus[number]))
        return split
    one, other = split.surface.joined
    chart = split.surface.chart[split.surface.polygon[one]]
    kept = np.isin(chart, wanting)
    cuts = []
    for number, own in by_chart(np.flatnonzero(kept), chart[kept]):
        local = _one_chart(split.surface, one[own], other[own], found.side[found.chart_of_loop[found.loop] == number])
        pairs = handle_cut(local) if genus[number] else sphere_cut(local)
        cuts.append(one[own[pairs]])
        what = f"genus {genus[number]}" if genus[number] else "closed"
        split.add_note(number, f"{what}: cut open along {len(pairs)} edges")
    return _with_surface(split, split.surface.cut_along(np.concatenate(cuts)))


def _closed_error(closed: bool, genus: int) -> TopologyError:
    if closed and not genus:
        return TopologyError(
            "The chart is closed, of genus 0: it has no boundary. Mark seams that cut it open, use sphere_map(), "
            'or pass closed="cut".'
        )
    state = f"closed, of genus {genus}: it has no boundary" if closed else f"of genus {genus}; a disk has no handles"
    return TopologyError(f'The chart is {state}. Mark seams that cut it open, or pass closed="cut".')


def _one_chart(surface: CutSurface, one: Ints, other: Ints, rim: Ints) -> OneChart:
    site, follow, polygon = surface.site, surface.follow, surface.polygon
    ends = np.concatenate((site[one], site[follow[one]], site[rim], site[follow[rim]]))
    sites, ends = np.unique(ends, return_inverse=True)
    tail, head, rim_tail, rim_head = np.split(ends, np.cumsum([len(one), len(one), len(rim)]))
    polygons, faces = np.unique(np.concatenate((polygon[one], polygon[other])), return_inverse=True)
    left, right = np.split(faces, 2)
    lengths = surface.side_lengths(one)
    return OneChart(tail, head, left, right, lengths, rim_tail, rim_head, len(sites), len(polygons))
