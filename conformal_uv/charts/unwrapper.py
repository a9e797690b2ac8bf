"""A mesh split into charts once, to be unwrapped again and again."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..linear.backends import choose_backend
from ..mesh.arrays import squared_units
from ..mesh.mesh_objects import MeshObject, polygons_of
from ..options import ChartOptions, DiskOptions, Laplacian, PlaceOptions, Shape, ShapeOptions, SplitOptions
from ..progress import Callback
from .arguments import Polygons, polygon_mesh, seam_pairs, selected_polygons, used_vertices, vertex_list
from .chart_atlas import ChartAtlas
from .chart_list import ChartList
from .chart_mapper import ChartMapper
from .chart_meshes import chart_meshes
from .chart_progress import PLACING, SPLITTING, ChartProgress
from .chart_solutions import ChartSolutions
from .disks import made_disks
from .named_vertices import NamedVertices
from .outlines import Outlines, joint_outlines, unit_disk
from .packing import ChartShape, Placements, placements
from .pinned_corners import PinnedCorners, pinned_corners
from .splitting import split_into_charts
from .unwrapped import Unwrapped

__all__ = ["Unwrapper"]

Vertices = int | Iterable[Any] | None
SHAPES = [field.name for field in fields(ShapeOptions)]
PLACES = [field.name for field in fields(PlaceOptions) if field.name != "rotation"]


class Unwrapper:
    """A mesh split into charts and factorized once.

    Parameters
    ----------
    V, polygons, seams, selection, outer_loop, laplacian, backend, callback, options
        As in `unwrap`, with the same errors; `options` are holes, closed, nonmanifold and orientation. Charts are
        factorized when they are first mapped.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> from conformal_uv.samples import mask
    >>> unwrapper = cuv.Unwrapper(*mask(500))
    >>> unwrapper.unwrap(rotation=0.1).summary, unwrapper.unwrap(method="linear").summary
    ('mapped 1 of 1 chart', 'mapped 1 of 1 chart')
    """

    def __init__(
        self,
        V: ArrayLike | MeshObject | None,
        polygons: Polygons | None = None,
        *,
        seams: ArrayLike | None = None,
        selection: ArrayLike | None = None,
        outer_loop: Vertices = None,
        laplacian: str = "auto",
        backend: str = "auto",
        callback: Callback | None = None,
        **options: Any,
    ) -> None:
        ChartProgress(callback).report("charts", 0.0)
        kind = Laplacian.of("laplacian", laplacian)
        choose_backend(backend)  # complains of what is not there before any work
        mesh, finite = polygon_mesh(*polygons_of(V, polygons))
        selected = selected_polygons(selection, mesh)
        self._corner_count, self._face_count = len(mesh.corners), len(mesh.sizes)
        self._used = used_vertices(mesh, selected)
        how = SplitOptions(outer_loop=vertex_list("outer_loop", outer_loop, self._used), **options)
        split = self._split = made_disks(split_into_charts(mesh, finite, selected, seam_pairs(seams), how), how)
        self._meshes = chart_meshes(split.mesh, split.surface, split.count)
        self._atlas = ChartAtlas(self._meshes, split.sound, kind, backend)
        self._selected, self._laplacian, self._backend = selected, kind, backend
        self._mappers: dict[int, ChartMapper] = {}

    def unwrap(
        self,
        *,
        pins: Vertices = None,
        pinned_uv: Mapping[int, ArrayLike] | None = None,
        center: Vertices = None,
        boundary_vertex: Vertices = None,
        rotation: float = 0.0,
        callback: Callback | None = None,
        **options: Any,
    ) -> Unwrapped:
        """Map all charts with the given options, those of `disk_map`, `ShapeOptions` and `PlaceOptions` among them; see
        `unwrap`.

        Factorizations are used again.
        """
        where = PlaceOptions(rotation=rotation, **{name: options.pop(name) for name in PLACES if name in options})
        shapes = ShapeOptions(**{name: options.pop(name) for name in SHAPES if name in options})
        how = ChartOptions(shape=shapes, disk=DiskOptions(**options), rotation=where.rotation)
        vertices = NamedVertices(
            vertex_list("center", center, self._used),
            vertex_list("boundary_vertex", boundary_vertex, self._used),
            vertex_list("pins", pins, self._used),
            ordered=not isinstance(pins, set | frozenset),
        )
        pinned = PinnedCorners(*pinned_corners(pinned_uv, self._corner_count), self._split, self._meshes)
        progress = ChartProgress(callback)
        progress.report("charts", SPLITTING)
        progress.weigh(self._meshes.weights())
        solutions = self._solved(shapes.of_charts(self._split.count), how, vertices, pinned, progress)
        self._check_used(vertices, solutions, offered=isinstance(pins, set | frozenset))
        progress.report("packing", PLACING)
        result = self._assembled(solutions, where)
        progress.report("packing", 1.0)
        return result

    def _solved(
        self,
        shapes: list[Shape],
        how: ChartOptions,
        vertices: NamedVertices,
        pinned: PinnedCorners,
        progress: ChartProgress,
    ) -> ChartSolutions:
        """All charts mapped: small ones together, the others and what is left of those one by one."""
        solutions = ChartSolutions(self._meshes)
        held = pinned.charts & np.array([one is Shape.FREE for one in shapes], dtype=bool)
        together = ~held
        if vertices:
            together &= ~self._meshes.with_any(
                np.concatenate((vertices.center, vertices.boundary_vertex, vertices.pins))
            )
        for shape in dict.fromkeys(shapes):
            wanted = together & np.array([one is shape for one in shapes], dtype=bool)
            for maps in self._atlas.maps(wanted, shape, how, progress):
                solutions.take(maps)
        callback = progress if progress.wanted else None
        for number in np.flatnonzero(~solutions.mapped).tolist():
            progress.start(number)
            pins = pinned.of_chart(number) if held[number] else None
            solutions.put(number, self._mapper(number).solve(shapes[number], how, vertices, callback, pins))
        return solutions

    def _mapper(self, number: int) -> ChartMapper:
        if number not in self._mappers:
            self._mappers[number] = ChartMapper(
                self._meshes[number], self._selected, self._split.faults.get(number), self._laplacian, self._backend
            )
        return self._mappers[number]

    def _check_used(self, vertices: NamedVertices, solutions: ChartSolutions, *, offered: bool) -> None:
        """Raise OptionError on a center, boundary vertex or pin that no chart could use; pins may be only `offered`.

        Charts that were mapped together have none of them.
        """
        if not vertices:
            return
        pairs = [(self._mapper(number), solution) for number, solution in solutions.alone.items()]
        excused = [mapper.mesh.vertices for mapper, solution in pairs if solution.map is None]
        if offered:
            excused.append(vertices.pins)
        for name, wanted in (("center", vertices.center), ("boundary_vertex", vertices.boundary_vertex)):
            for mapper, solution in pairs:  # of several in one chart the first is taken, and a note tells of the others
                if solution.map is not None and len(solution.used[name]):
                    excused.append(wanted[np.isin(wanted, mapper.mesh.vertices)])
        vertices.check_used(
            [solution.used for _, solution in pairs if solution.map is not None],
            np.concatenate([np.empty(0, dtype=np.int64), *excused]),
        )

    def _assembled(self, solutions: ChartSolutions, where: PlaceOptions) -> Unwrapped:
        """Place the charts that nothing holds and gather the corners' coordinates."""
        surface, split, meshes = self._split.surface, self._split, self._meshes
        mapped, loose = solutions.mapped, solutions.mapped & ~solutions.held
        area = squared_units(meshes.area, meshes.unit) if where.keep_scale else meshes.area
        found = placements(where, area[loose], solutions.image_areas()[loose], self._outlines(solutions, loose))
        placed = Placements.untouched(split.count)
        placed.put(loose, found)
        own = np.flatnonzero(meshes.site[: meshes.first_vertex[-1]] < len(surface.vertex_of_site))
        chart = meshes.chart_of_vertex[own]
        z: NDArray[np.complex128] = np.zeros(len(surface.vertex_of_site), dtype=np.complex128)
        z[meshes.site[own]] = placed.placed(solutions.z[own], chart)
        uv = np.zeros((self._corner_count, 2))
        uv[split.corner] = z[surface.site[: len(split.corner)]].view(np.float64).reshape(-1, 2)
        chart_of_face = np.full(self._face_count, -1, dtype=np.int64)
        chart_of_face[split.selected] = surface.chart[: surface.real]
        done = np.append(mapped, False)[chart_of_face]
        return Unwrapped(uv, chart_of_face, done, ChartList(split, meshes, solutions, placed))

    def _outlines(self, solutions: ChartSolutions, loose: NDArray[np.bool_]) -> Outlines | list[ChartShape] | None:
        """What covers each loose chart, of disks the whole disk; None where all are disks."""
        meshes = self._meshes
        disks = solutions.is_disk[loose]
        if disks.all():
            return None
        if not disks.any():
            number = np.where(loose, np.cumsum(loose) - 1, -1)[meshes.chart_of_face]
            return joint_outlines(solutions.z, meshes.F_of_all[number >= 0].T, number[number >= 0])
        disk = unit_disk()
        return [
            disk
            if solutions.is_disk[number]
            else (solutions.z[meshes.first_vertex[number] : meshes.first_virtual[number]], meshes[number].F.T)
            for number in np.flatnonzero(loose).tolist()
        ]
