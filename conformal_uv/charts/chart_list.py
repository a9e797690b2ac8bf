"""All charts of an unwrapped mesh, each of them made when it is looked at."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import overload

import numpy as np
from numpy.typing import NDArray

from ..free import FreeMap
from ..mesh.arrays import scaled_each, squared_units
from ..mesh.geometry import triangle_geometry
from ..operators.distortion import RATIOS, Distortion, distortion_of
from ..operators.wirtinger import planar_sides, signed_double_areas
from ..rectangle import RectangleMap
from .chart import Chart
from .chart_meshes import ChartMeshes
from .chart_solutions import ChartSolutions
from .packing import Placements
from .splitting import Split

__all__ = ["ChartList"]

Ints = NDArray[np.int64]


class ChartList(Sequence[Chart]):
    """The charts in the order of their first polygons; what concerns all of them is answered without making any.

    Attributes
    ----------
    mapped : (c,) bool
        Which charts have a map.
    held : (c,) bool
        Which of them lie where pinned corners are: no packing moves them.
    errors : dict of int to ConformalUVError
        Why the others have none.
    split : Split
    meshes : ChartMeshes
    solutions : ChartSolutions
    placed : Placements
    """

    def __init__(self, split: Split, meshes: ChartMeshes, solutions: ChartSolutions, placed: Placements) -> None:
        self.split, self.meshes, self.solutions, self.placed = split, meshes, solutions, placed
        self.mapped, self.held, self.errors = solutions.mapped, solutions.held, solutions.errors
        chart_of_polygon = split.surface.chart[: split.surface.real]
        self._faces = split.selected[np.argsort(chart_of_polygon, kind="stable")]
        self._first = np.concatenate(([0], np.cumsum(np.bincount(chart_of_polygon, minlength=split.count))))
        self._made: dict[int, Chart] = {}

    def __repr__(self) -> str:
        return f"ChartList of {len(self)} charts, {int(self.mapped.sum())} mapped"

    def __len__(self) -> int:
        return self.split.count

    @overload
    def __getitem__(self, index: int) -> Chart: ...
    @overload
    def __getitem__(self, index: slice) -> list[Chart]: ...
    def __getitem__(self, index: int | slice) -> Chart | list[Chart]:
        if isinstance(index, slice):
            return [self[number] for number in range(*index.indices(len(self)))]
        number = range(len(self))[index]
        if number not in self._made:
            self._made[number] = Chart(self, number)
        return self._made[number]

    @property
    def chart_of_triangle(self) -> Ints:
        """The chart of each triangle of all charts, (m,)."""
        return self.meshes.chart_of_face

    @cached_property
    def corner(self) -> Ints:
        """The caller's polygon corner at each corner of these, (m, 3)."""
        return self.split.corner[self.meshes.corner]

    @cached_property
    def polygon(self) -> Ints:
        """The caller's polygon of each of these triangles, (m,)."""
        return self.split.selected[self.meshes.polygon]

    @property
    def shaped(self) -> list[FreeMap | RectangleMap]:
        """The maps to other shapes than disks."""
        other = np.flatnonzero(self.mapped & ~self.solutions.is_disk)
        maps = [self.solutions.map(number) for number in other.tolist()]
        return [found for found in maps if isinstance(found, FreeMap | RectangleMap)]

    def surface_areas(self) -> NDArray[np.float64]:
        """Area of each chart, (c,), in the units of the positions squared; infinite where doubles end."""
        return squared_units(self.meshes.area, self.meshes.unit)

    def image_areas(self, uv: NDArray[np.float64]) -> NDArray[np.float64]:
        """Area of each chart's triangles, (c,), at coordinates (k, 2) of every polygon corner."""
        z = np.ascontiguousarray(uv, dtype=np.float64).view(np.complex128).reshape(-1)
        signed = signed_double_areas(planar_sides(z, self.corner.T.astype(np.int32)))
        return 0.5 * np.bincount(self.chart_of_triangle, np.abs(signed), minlength=len(self))

    def distortion(self, taken: NDArray[np.bool_]) -> tuple[Distortion, NDArray[np.int64]]:
        """Distortion of the maps of some charts (c,), each in its own plane, on their triangles, and which these are.

        Angles and ratios are those of `Chart.distortion`, area scales those of `ChartSolutions.z`.
        """
        own = np.flatnonzero(taken[self.chart_of_triangle])
        chart = self.chart_of_triangle[own]
        of_vertex = self.meshes.chart_of_vertex  # vertices of no chart come last
        V, unit = scaled_each(self.meshes.V[: len(of_vertex)], of_vertex, len(self))
        corners = np.ascontiguousarray(self.meshes.F_of_all[own].T.astype(np.int32))
        z = self.solutions.z.view(np.float64).reshape(-1, 2)
        found = distortion_of(triangle_geometry(V, corners), corners, z)
        with np.errstate(over="ignore", under="ignore"):
            ratio = np.clip(unit, *RATIOS)[chart]
            return replace(found, area_scale=found.area_scale / ratio / ratio), own

    def flipped(self, numbers: Ints) -> Ints:
        """The caller's polygons with a folded triangle, of some charts one after the other; see `Chart`."""
        folded = self.solutions.folded
        return np.concatenate([np.empty(0, dtype=np.int64), *(self[k].flipped for k in numbers if folded[k])])

    def faces_of(self, number: int) -> Ints:
        """The caller's polygons of a chart."""
        return self._faces[self._first[number] : self._first[number + 1]]

    def notes_of(self, number: int) -> list[str]:
        """What is to be said of a chart."""
        return self.split.notes.get(number, []) + self.solutions.notes(number)

    def notes(self, numbers: Ints) -> list[str]:
        """What is to be said of some charts, one after the other."""
        spoken = self.solutions.spoken | self.split.notes.keys()
        return [note for number in numbers.tolist() if number in spoken for note in self.notes_of(number)]

    @property
    def converged(self) -> NDArray[np.bool_]:
        """Charts whose methods reached their tolerance, (c,)."""
        return self.solutions.converged
