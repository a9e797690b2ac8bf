"""What makes a chart unmappable, found on the whole mesh at once and told in the caller's own numbers.

The maps below check every mesh again; but they number the vertices and faces of one chart's triangles, which mean
nothing to the caller. Whatever can be told from the polygons is therefore looked for here first.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from ..errors import (
    ConformalUVError,
    DegenerateFaceError,
    DuplicateFaceError,
    NonFiniteError,
    NonManifoldError,
    Remedy,
    listed,
)
from ..mesh.fans import corner_links, pinched_vertices
from ..mesh.halfedges import joined_pairs
from ..options import NonManifold
from .selected_part import SelectedPart, crowded_pairs

__all__ = ["Faults", "by_chart", "note_crowded_edges", "note_pinched_vertices", "note_unusable_polygons"]

Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

CUT = Remedy("nonmanifold", NonManifold.CUT)


class Faults(dict[int, ConformalUVError]):
    """The first error found of each chart."""

    def note(self, items: Ints, chart: Ints, tell: Callable[[Ints], ConformalUVError]) -> None:
        """Record ``tell(its items)`` for every chart that has some of the items and no error yet."""
        for number, own in by_chart(items, chart):
            if number not in self:
                self[number] = tell(own)

    def sound(self, count: int) -> Bools:
        """Which of `count` charts have no error, (count,)."""
        mask = np.ones(count, dtype=bool)
        mask[list(self)] = False
        return mask


def by_chart(items: Ints, chart: Ints) -> Iterator[tuple[int, Ints]]:
    """The items of each chart, charts in increasing order, items in theirs."""
    order = np.argsort(chart, kind="stable")
    numbers, start = np.unique(chart[order], return_index=True)
    for number, own in zip(numbers, np.split(items[order], start[1:]), strict=False):
        yield int(number), own


def note_unusable_polygons(faults: Faults, part: SelectedPart, finite: Bools, chart: Ints, name: Ints) -> None:
    """Positions that are not finite, repeated vertices, polygons that stand twice.

    Parameters
    ----------
    chart, name : (p,)
        Chart and index at the caller's of each polygon.
    """
    corners, polygon = part.mesh.corners, part.sides.polygon
    nowhere = np.flatnonzero(~finite[corners]) if not finite.all() else np.empty(0, dtype=np.int64)
    faults.note(corners[nowhere], chart[polygon[nowhere]], _nowhere)
    repeating = _repeating(part)
    faults.note(
        name[repeating],
        chart[repeating],
        lambda own: DegenerateFaceError(
            f"{len(own)} faces repeat a vertex: faces {listed(own)}. Remove the repeated corners.", own
        ),
    )
    twice = _standing_twice(part)
    faults.note(
        name[twice],
        chart[twice],
        lambda own: DuplicateFaceError(
            f"{len(own)} faces have the same edges as another: faces {listed(own)}. Keep one of each.", own
        ),
    )


def note_crowded_edges(faults: Faults, part: SelectedPart, chart: Ints, name: Ints) -> None:
    """Edges of three or more polygons that are no seams."""
    n = len(part.mesh.V)
    sides = np.flatnonzero((part.sides.twin == -2) & ~part.seam[part.sides.edge])

    def tell(own: Ints) -> ConformalUVError:
        keys = part.sides.key[np.unique(part.sides.edge[own])]
        places = ", ".join(f"({key // n}, {key % n})" for key in keys[:8])
        faces = np.unique(name[part.sides.polygon[own]])
        return NonManifoldError(
            f"{len(keys)} edges have three or more faces: edges {places}{' ...' if len(keys) > 8 else ''} of faces "
            f"{listed(faces)}.",
            faces,
            ("remove the extra faces", "mark the edges as seams", CUT),
        )

    faults.note(sides, chart[part.sides.polygon[sides]], tell)


def note_pinched_vertices(faults: Faults, part: SelectedPart, elsewhere: Bools, chart: Ints, name: Ints) -> Bools:
    """Vertices at which polygons touch without sharing an edge, (n,) bool.

    Seams do not pinch, nor does the border of the selection: no error is noted for vertices that other polygons
    use too (`elsewhere`, (n,)).
    """
    corners, polygon, follow = part.mesh.corners, part.sides.polygon, part.sides.follow
    pairs, extra = joined_pairs(part.sides.twin), crowded_pairs(part, np.ones_like(part.seam))
    one, other = (np.concatenate(ends) for ends in zip(pairs, extra, strict=True))
    pinched = np.zeros(len(elsewhere), dtype=bool)
    pinched[pinched_vertices(corners, *corner_links(corners, follow, one, other), len(elsewhere))] = True
    bad = np.flatnonzero((pinched & ~elsewhere)[corners])

    def tell(own: Ints) -> ConformalUVError:
        vertices, faces = np.unique(corners[own]), np.unique(name[polygon[own]])
        return NonManifoldError(
            f"{len(vertices)} vertices join parts of the surface that touch only there: vertices {listed(vertices)} "
            f"of faces {listed(faces)}.",
            faces,
            ("give each part a vertex of its own", CUT),
        )

    faults.note(bad, chart[polygon[bad]], tell)
    return pinched


def _nowhere(own: Ints) -> ConformalUVError:
    vertices = np.unique(own)
    return NonFiniteError(
        f"{len(vertices)} vertices have a NaN or infinite coordinate: vertices {listed(vertices)}. "
        "Give them positions, or leave out their faces.",
        vertices,
    )


def _repeating(part: SelectedPart) -> Ints:
    """Polygons with a vertex at two corners."""
    sizes, starts, corners = part.mesh.sizes, part.mesh.starts, part.mesh.corners
    found = [np.empty(0, dtype=np.int64)]
    for size in np.unique(sizes):
        same = np.flatnonzero(sizes == size)
        rows = np.sort(corners[starts[same, None] + np.arange(size)], axis=1)
        found.append(same[(rows[:, 1:] == rows[:, :-1]).any(axis=1)])
    return np.sort(np.concatenate(found))


def _standing_twice(part: SelectedPart) -> Ints:
    """Polygons with the same edges as another.

    Across its edges such a polygon meets one and the same other, or crowds; only those are compared.
    """
    sides, starts = part.sides, part.mesh.starts
    across = np.where(sides.twin >= 0, sides.polygon[sides.twin], sides.twin)
    crowded = across == -2
    low = np.minimum.reduceat(np.where(crowded, len(starts), across), starts[:-1])
    high = np.maximum.reduceat(across, starts[:-1])
    suspects = np.flatnonzero((high == -2) | ((low == high) & (low >= 0)))
    seen: dict[tuple[int, ...], list[int]] = {}
    for p in suspects.tolist():
        seen.setdefault(tuple(sorted(sides.edge[starts[p] : starts[p + 1]].tolist())), []).append(p)
    return np.sort(np.array([p for group in seen.values() if len(group) > 1 for p in group], dtype=np.int64))
