"""Which of the vertices that a caller names (centers, boundary vertices, pins) a chart can use."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..errors import OptionError, listed
from ..options import CornerChoice, DiskOptions, FreeOptions, RectangleOptions

__all__ = ["NamedVertices", "vertices_used"]

Ints = NDArray[np.int64]

COUNTS = {3: "three", 4: "four"}
NEEDED = {
    "center": "a center lies in the interior of a chart.",
    "boundary_vertex": "a boundary vertex lies on the outer boundary of a chart.",
    "pins": "a disk takes exactly three, a rectangle four as its corners, all on the outer boundary of the chart.",
}


@dataclass(frozen=True, eq=False)
class NamedVertices:
    """Vertices in the caller's numbers, of all charts together; `ordered` tells whether the order of pins means
    something."""

    center: Ints
    boundary_vertex: Ints
    pins: Ints
    ordered: bool = True

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

    def of_disk(self, options: DiskOptions, vertices: Ints, boundary: Ints) -> tuple[DiskOptions, list[str]]:
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
        pins = self._pins(vertices, boundary, 3, notes)
        own = None if pins is None else (pins[0], pins[1], pins[2])
        return replace(options, center=center, boundary_vertex=rim, pins=own), notes

    def of_rectangle(
        self, options: RectangleOptions, vertices: Ints, boundary: Ints
    ) -> tuple[RectangleOptions, list[str]]:
        """The same for a rectangle, whose corners are the pins."""
        notes = self._unused(("center", "boundary_vertex"), vertices, "a rectangle has none")
        pins = self._pins(vertices, boundary, 4, notes)
        if pins is None:
            return options, notes
        corners = pins[0], pins[1], pins[2], pins[3]
        return replace(options, corners=corners, corner_choice=CornerChoice.TURNING), notes

    def of_free(self, vertices: Ints) -> list[str]:
        """What is to be said of those in a chart with a free boundary, which uses none."""
        return self._unused(("center", "boundary_vertex", "pins"), vertices, "the boundary is free")

    def _unused(self, names: tuple[str, ...], vertices: Ints, why: str) -> list[str]:
        told = [(name, np.intersect1d(getattr(self, name), vertices)) for name in names]
        return [f"{name} {listed(here)} not used: {why}" for name, here in told if len(here)]

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

    def _pins(self, vertices: Ints, boundary: Ints, count: int, notes: list[str]) -> list[int] | None:
        """So many pins in the order of the loop, beginning with the one that was named first."""
        on_loop = np.unique(self.pins[np.isin(self.pins, vertices[boundary])])
        if len(on_loop) != count:
            here = np.unique(self.pins[np.isin(self.pins, vertices)])
            if len(here):
                notes.append(
                    f"not pinned: of its pins {listed(here)}, {len(on_loop)} are on its boundary, not {COUNTS[count]}"
                )
            return None
        place = [int(np.flatnonzero(vertices[boundary] == pin)[0]) for pin in on_loop]
        named = [int(np.flatnonzero(self.pins == pin)[0]) for pin in on_loop]
        lead = place[int(np.argmin(named))]
        taken = sorted(place, key=lambda at: (at - lead) % len(boundary))
        given = [place[k] for k in np.argsort(named)]
        if self.ordered and given != taken:
            told = ", ".join(str(vertices[boundary[at]]) for at in taken)
            notes.append(f"pins taken in the order of the boundary: {told}")
        return [int(boundary[at]) for at in taken]


def vertices_used(options: DiskOptions | FreeOptions | RectangleOptions, vertices: Ints) -> dict[str, Ints]:
    """The caller's vertices that a chart's options name, by option; `vertices` as in `NamedVertices.of_disk`."""
    own: dict[str, list[int | None]] = {"center": [], "boundary_vertex": [], "pins": []}
    if isinstance(options, DiskOptions):
        own = {
            "center": [options.center],
            "boundary_vertex": [options.boundary_vertex],
            "pins": [*(options.pins or ())],
        }
    elif isinstance(options, RectangleOptions):
        own["pins"] = [*(options.corners or ())]
    return {name: vertices[[v for v in taken if v is not None]] for name, taken in own.items()}
