"""Which of the vertices that a caller names (centers, boundary vertices, pins) a chart can use."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..errors import OptionError, listed
from ..options import DiskOptions

__all__ = ["NamedVertices", "vertices_used"]

Ints = NDArray[np.int64]

NEEDED = {
    "center": "a center lies in the interior of a chart.",
    "boundary_vertex": "a boundary vertex lies on the outer boundary of a chart.",
    "pins": "a chart takes exactly three, all on its outer boundary.",
}


@dataclass(frozen=True, eq=False)
class NamedVertices:
    """Vertices in the caller's numbers, of all charts together."""

    center: Ints
    boundary_vertex: Ints
    pins: Ints

    def __bool__(self) -> bool:
        return bool(len(self.center) or len(self.boundary_vertex) or len(self.pins))

    def check_used(self, used: list[dict[str, Ints]], excused: Ints) -> None:
        """Raise OptionError on vertices that no chart could use, but for those `excused`.

        Parameters
        ----------
        used : list of dict
            What each chart used.
        excused : (k,)
            Vertices of charts that could not be mapped for other reasons, and vertices beside one that was used.
        """
        for name, wanted in (("center", self.center), ("boundary_vertex", self.boundary_vertex), ("pins", self.pins)):
            taken = np.concatenate([excused, *(chart[name] for chart in used)])
            bad = np.unique(wanted[~np.isin(wanted, taken)])
            if len(bad):
                raise OptionError(f"{name}: no chart can use vertices {listed(bad)}; {NEEDED[name]}", bad)

    def of_chart(self, options: DiskOptions, vertices: Ints, boundary: Ints) -> tuple[DiskOptions, list[str]]:
        """The options with the vertices that a chart uses, in its own numbers, and what is to be said about them.

        Parameters
        ----------
        vertices : (n,)
            The caller's vertex of each vertex of the chart that is not virtual.
        boundary : (nb,)
            Its loop, in the chart's numbers.
        """
        if not self:
            return options, []
        notes: list[str] = []
        inside = np.ones(len(vertices), dtype=bool)
        inside[boundary] = False
        center = self._first("center", self.center, vertices, np.flatnonzero(inside), notes)
        rim = self._first("boundary_vertex", self.boundary_vertex, vertices, boundary, notes)
        pins = self._pins(vertices, boundary, notes)
        return replace(options, center=center, boundary_vertex=rim, pins=pins), notes

    def _first(self, name: str, wanted: Ints, vertices: Ints, allowed: Ints, notes: list[str]) -> int | None:
        """The first wanted vertex among those allowed; a note on those that lie elsewhere in the chart or are more
        than one."""
        here = wanted[np.isin(wanted, vertices)]
        usable = here[np.isin(here, vertices[allowed])]
        unused = here[~np.isin(here, usable[:1])]
        if len(unused):
            where = "interior" if name == "center" else "on the boundary"
            why = "one is enough" if len(usable) else f"not {where} here"
            notes.append(f"{name} {listed(unused)} not used: {why}")
        return int(allowed[vertices[allowed] == usable[0]][0]) if len(usable) else None

    def _pins(self, vertices: Ints, boundary: Ints, notes: list[str]) -> tuple[int, int, int] | None:
        """Three pins in the order of the loop, beginning with the one that was named first."""
        on_loop = np.unique(self.pins[np.isin(self.pins, vertices[boundary])])
        if len(on_loop) != 3:
            here = np.unique(self.pins[np.isin(self.pins, vertices)])
            if len(here):
                notes.append(f"not pinned: of its pins {listed(here)}, {len(on_loop)} are on its boundary, not three")
            return None
        place = [int(np.flatnonzero(vertices[boundary] == pin)[0]) for pin in on_loop]
        named = [int(np.flatnonzero(self.pins == pin)[0]) for pin in on_loop]
        lead = place[int(np.argmin(named))]
        a, b, c = sorted(place, key=lambda at: (at - lead) % len(boundary))
        given = [place[k] for k in np.argsort(named)]
        if given != [a, b, c]:
            told = ", ".join(str(vertices[boundary[at]]) for at in (a, b, c))
            notes.append(f"pins taken in the order of the boundary: {told}")
        return int(boundary[a]), int(boundary[b]), int(boundary[c])


def vertices_used(options: DiskOptions, vertices: Ints) -> dict[str, Ints]:
    """The caller's vertices that a chart's options name, by option; `vertices` as in `NamedVertices.of_chart`."""
    own = {"center": [options.center], "boundary_vertex": [options.boundary_vertex], "pins": options.pins or []}
    return {name: vertices[[v for v in taken if v is not None]] for name, taken in own.items()}
