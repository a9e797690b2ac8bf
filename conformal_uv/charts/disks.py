"""Charts made into disks: holes filled, closed charts and handles cut open, or the reason why that is refused."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import OptionError, Remedy, TopologyError, listed
from ..options import Closed, Holes, SplitOptions
from .boundary_loops import BoundaryLoops, boundary_loops, filled, genera, without_digons, zipped
from .cut_graph import OneChart, handle_cut, sphere_cut
from .cut_surface import CutSurface
from .faults import by_chart
from .splitting import Split

__all__ = ["made_disks"]

Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

CUT = Remedy("closed", Closed.CUT)


def made_disks(split: Split, options: SplitOptions) -> Split:
    """Choose the outer loops, fill the holes, cut closed charts and handles, or note why that is refused.

    Raises
    ------
    OptionError
        A vertex of `outer_loop` that is on no boundary.
    """
    surface, sound = split.surface, split.sound
    found = boundary_loops(surface, sound)
    faulty = surface.vertex[~sound[surface.chart[surface.polygon]]]
    _check_outer_loop(options.outer_loop, np.concatenate((surface.vertex[found.side], faulty)))
    inner = _inner_loops(split, found, options)
    if inner.any() and options.holes is Holes.REFUSE:
        _refuse_holes(split, found, inner)
    elif inner.any():
        surface = without_digons(zipped(split.surface, found, inner, split.across), sound)
        if surface is not split.surface:
            changed = split.surface.polygon[np.flatnonzero(surface.twin != split.surface.twin)]
            for number in np.unique(split.surface.chart[changed]):
                split.add_note(int(number), "seams that end inside the chart were closed")
            split = split.with_surface(surface)
            found = boundary_loops(surface, split.sound)
            inner = _inner_loops(split, found, options)
        for number, holes in enumerate(np.bincount(found.chart_of_loop[inner], minlength=split.count).tolist()):
            if holes:
                split.add_note(number, f"{holes} hole{'s' * (holes > 1)} filled for the solution")
        split = split.with_surface(filled(split.surface, found, inner))
    return _cut_to_disks(split, options)


def _check_outer_loop(wanted: Ints | None, allowed: Ints) -> None:
    if wanted is None:
        return
    bad = wanted[~np.isin(wanted, allowed)]
    if len(bad):
        raise OptionError(f"outer_loop: vertices {listed(bad)} are on no boundary loop.", bad)


def _inner_loops(split: Split, found: BoundaryLoops, options: SplitOptions) -> Bools:
    outer = found.outer_loops(split.count, options.outer_loop, split.surface)
    inner = np.ones(len(found.length), dtype=bool)
    inner[outer[outer >= 0]] = False
    return inner


def _refuse_holes(split: Split, found: BoundaryLoops, inner: Bools) -> None:
    loops = np.flatnonzero(np.isin(found.chart_of_loop, found.chart_of_loop[inner]))
    first = split.surface.vertex[found.side[found.steps == 0]]
    edges = np.bincount(found.loop, minlength=len(inner))

    def tell(own: Ints) -> TopologyError:
        told = ", ".join(f"{edges[i]} edges at vertex {first[i]}" for i in own[:8])
        return TopologyError(
            f"The chart has {len(own)} boundary loops ({told}{', ...' if len(own) > 8 else ''}); a disk has one.",
            first[own],
            ("fill the holes", "mark a seam between them", Remedy("holes", Holes.FILL)),
        )

    split.faults.note(loops, found.chart_of_loop[loops], tell)


def _cut_to_disks(split: Split, options: SplitOptions) -> Split:
    """Open closed charts and handles."""
    sound = split.sound
    found = boundary_loops(split.surface, sound)
    genus = genera(split.surface, found, split.count)
    closed = np.bincount(found.chart_of_loop, minlength=split.count) == 0
    wanting = np.flatnonzero(sound & (closed | (genus > 0)))
    if not len(wanting):
        return split
    if options.closed is Closed.REFUSE:
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
    return split.with_surface(split.surface.cut_along(np.concatenate(cuts)))


def _closed_error(closed: bool, genus: int) -> TopologyError:
    if closed and not genus:
        return TopologyError(
            "The chart is closed, of genus 0: it has no boundary.",
            ways=("mark seams that cut it open", Remedy("sphere_map"), CUT),
        )
    state = f"closed, of genus {genus}: it has no boundary" if closed else f"of genus {genus}; a disk has no handles"
    return TopologyError(f"The chart is {state}.", ways=("mark seams that cut it open", CUT))


def _one_chart(surface: CutSurface, one: Ints, other: Ints, rim: Ints) -> OneChart:
    site, follow, polygon = surface.site, surface.follow, surface.polygon
    ends = np.concatenate((site[one], site[follow[one]], site[rim], site[follow[rim]]))
    sites, ends = np.unique(ends, return_inverse=True)
    tail, head, rim_tail, rim_head = np.split(ends, np.cumsum([len(one), len(one), len(rim)]))
    polygons, faces = np.unique(np.concatenate((polygon[one], polygon[other])), return_inverse=True)
    left, right = np.split(faces, 2)
    lengths = surface.side_lengths(one)
    return OneChart(tail, head, left, right, lengths, rim_tail, rim_head, len(sites), len(polygons))
