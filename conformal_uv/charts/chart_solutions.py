"""The maps of all charts: of those that were solved together, and of those that were solved one by one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..atlas import DiskMaps, FreeMaps
from ..disk import DiskMap
from ..errors import ConformalUVError
from ..operators.wirtinger import planar_sides, signed_double_areas
from .chart_mapper import ChartSolution, ShapeMap
from .chart_meshes import ChartMeshes

__all__ = ["ChartSolutions"]

Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Real = NDArray[np.float64]


class ChartSolutions:
    """What became of c charts.

    Attributes
    ----------
    z : (n,) complex128
        Positions of the vertices of all charts, each chart in its own plane as `ChartSolution` has it; 0 where nothing
        was mapped.
    mapped, is_disk, held : (c,) bool
        Charts that have a map, those whose map is that of a disk, and those that pinned corners hold where they are.
    alone : dict of ChartSolution
        Of the charts that were solved one by one.
    """

    def __init__(self, meshes: ChartMeshes) -> None:
        self._meshes = meshes
        count = len(meshes.area)
        self.z = np.zeros(len(meshes.V), dtype=np.complex128)
        self.mapped, self.is_disk, self.held = (np.zeros(count, dtype=bool) for _ in range(3))
        self.alone: dict[int, ChartSolution] = {}
        self._together: list[DiskMaps | FreeMaps] = []
        self._where = np.full((count, 2), -1, dtype=np.int64)  # the maps that a chart is among, and its place there

    def put(self, number: int, solution: ChartSolution) -> None:
        """The solution of one chart."""
        self.alone[number] = solution
        if solution.map is not None:
            first = self._meshes.first_vertex[number]
            self.z[first : first + len(solution.z)] = solution.z
            self.mapped[number], self.is_disk[number] = True, isinstance(solution.map, DiskMap)
            self.held[number] = solution.held

    def take(self, maps: DiskMaps | FreeMaps) -> None:
        """The maps of several charts, those that are good."""
        disks, good = maps.disks, np.flatnonzero(maps.good)
        number = disks.number[good]
        self._where[number, 0], self._where[number, 1] = len(self._together), good
        self._together.append(maps)
        self.mapped[number], self.is_disk[number] = True, maps.to_disks
        taken = maps.good[disks.of_vertex]
        shift = self._meshes.first_vertex[disks.number] - disks.first_vertex[:-1]
        self.z[np.flatnonzero(taken) + shift[disks.of_vertex[taken]]] = maps.z[taken]

    def map(self, number: int) -> ShapeMap | None:
        """The map of a chart."""
        if number in self.alone:
            return self.alone[number].map
        which, place = self._where[number].tolist()
        return self._together[which][place]

    def notes(self, number: int) -> list[str]:
        """What is to be said of a chart."""
        return self.alone[number].notes if number in self.alone else []

    @property
    def spoken(self) -> set[int]:
        """Charts of which something is to be said."""
        return {number for number, one in self.alone.items() if one.notes}

    @property
    def errors(self) -> dict[int, ConformalUVError]:
        """Why charts were not mapped."""
        return {number: one.error for number, one in sorted(self.alone.items()) if one.error is not None}

    @property
    def converged(self) -> Bools:
        """Charts whose methods reached their tolerance, (c,)."""
        out = self.mapped.copy()
        for number, one in self.alone.items():
            out[number] = one.map is not None and one.map.converged
        return out

    @property
    def folded(self) -> Bools:
        """Charts with folded triangles, (c,); of those mapped together none has any."""
        out = np.zeros(len(self.mapped), dtype=bool)
        for number, one in self.alone.items():
            out[number] = one.map is not None and len(one.map.flipped) > 0
        return out

    def lost_to_double(self) -> Ints:
        """Number of each chart's triangles that doubles can not hold, (c,); of those mapped together none."""
        lost: Ints = np.zeros(len(self.mapped), dtype=np.int64)
        for number, one in self.alone.items():
            if one.map is not None and len(one.map.flipped):
                lost[number] = len(one.map.lost_to_double)
        return lost

    def energies(self) -> tuple[Real, Real]:
        """Conformal and Dirichlet energies of the maps, (c,), 0 where there is none."""
        conformal, dirichlet = np.zeros(len(self.mapped)), np.zeros(len(self.mapped))
        for maps in self._together:
            own, good = maps.disks.number[maps.good], maps.good
            conformal[own], dirichlet[own] = maps.conformal[good], maps.dirichlet[good]
        for number, one in self.alone.items():
            if one.map is not None:
                conformal[number], dirichlet[number] = one.map.conformal_energy, one.map.dirichlet_energy
        return conformal, dirichlet

    def image_areas(self) -> Real:
        """Areas of the images of the charts' own triangles, (c,)."""
        meshes = self._meshes
        corners = meshes.F_of_all.T.astype(np.int32)
        signed = signed_double_areas(planar_sides(self.z, corners))
        return 0.5 * np.bincount(meshes.chart_of_face, np.abs(signed), minlength=len(self.mapped))
