"""A mesh split into charts once, to be unwrapped again and again."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..disk import DiskMap
from ..linear.backends import choose_backend
from ..options import ChartOptions, DiskOptions, Laplacian, Place, PlaceOptions, ShapeOptions, SplitOptions
from ..progress import Callback
from .arguments import Polygons, polygon_mesh, seam_pairs, selected_polygons, used_vertices, vertex_list
from .chart import Chart, Unwrapped
from .chart_mapper import ChartMapper, ChartSolution
from .chart_meshes import ChartMesh, chart_meshes
from .chart_progress import PLACING, SPLITTING, ChartProgress
from .disks import made_disks
from .named_vertices import NamedVertices
from .outlines import unit_disk
from .packing import Placement, placements
from .splitting import split_into_charts

__all__ = ["Unwrapper"]

Vertices = int | Iterable[Any] | None
Outline = tuple[NDArray[np.complex128], NDArray[np.int64]]
SHAPES = fields(ShapeOptions)


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
        V: ArrayLike | None,
        polygons: Polygons,
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
        mesh, finite = polygon_mesh(V, polygons)
        selected = selected_polygons(selection, mesh)
        self._corner_count, self._face_count = len(mesh.corners), len(mesh.sizes)
        self._used = used_vertices(mesh, selected)
        how = SplitOptions(outer_loop=vertex_list("outer_loop", outer_loop, self._used), **options)
        split = self._split = made_disks(split_into_charts(mesh, finite, selected, seam_pairs(seams), how), how)
        self._meshes = chart_meshes(split.mesh, split.surface, split.count)
        self._mappers = [
            ChartMapper(self._meshes[number], selected, split.faults.get(number), kind, backend)
            for number in range(split.count)
        ]

    def unwrap(
        self,
        *,
        pins: Vertices = None,
        center: Vertices = None,
        boundary_vertex: Vertices = None,
        place: str = "fit",
        margin: float | None = None,
        rotation: float = 0.0,
        callback: Callback | None = None,
        **options: Any,
    ) -> Unwrapped:
        """Map all charts with the given options, those of `disk_map` and of `ShapeOptions` among them; see `unwrap`.

        Factorizations are used again.
        """
        where = PlaceOptions(place=Place.of("place", place), margin=margin, rotation=rotation)
        shapes = ShapeOptions(**{field.name: options.pop(field.name) for field in SHAPES if field.name in options})
        how = ChartOptions(shape=shapes, disk=DiskOptions(**options), rotation=where.rotation)
        vertices = NamedVertices(
            vertex_list("center", center, self._used),
            vertex_list("boundary_vertex", boundary_vertex, self._used),
            vertex_list("pins", pins, self._used),
            ordered=not isinstance(pins, set | frozenset),
        )
        progress = ChartProgress(callback)
        progress.report("charts", SPLITTING)
        progress.weigh(self._meshes.weights())
        solutions = []
        for number, (mapper, shape) in enumerate(zip(self._mappers, shapes.of_charts(len(self._mappers)), strict=True)):
            progress.start(number)
            solutions.append(mapper.solve(shape, how, vertices, progress if progress.wanted else None))
        self._check_used(vertices, solutions, offered=isinstance(pins, set | frozenset))
        progress.report("packing", PLACING)
        result = self._assembled(solutions, where)
        progress.report("packing", 1.0)
        return result

    def _check_used(self, vertices: NamedVertices, solutions: list[ChartSolution], *, offered: bool) -> None:
        """Raise OptionError on a center, boundary vertex or pin that no chart could use; pins may be only `offered`."""
        if not vertices:
            return
        pairs = list(zip(self._mappers, solutions, strict=True))
        excused = [mapper.mesh.vertices for mapper, solution in pairs if solution.map is None]
        if offered:
            excused.append(vertices.pins)
        for name, wanted in (("center", vertices.center), ("boundary_vertex", vertices.boundary_vertex)):
            for mapper, solution in pairs:  # of several in one chart the first is taken, and a note tells of the others
                if solution.map is not None and len(solution.used[name]):
                    excused.append(wanted[np.isin(wanted, mapper.mesh.vertices)])
        vertices.check_used(
            [solution.used for solution in solutions if solution.map is not None],
            np.concatenate([np.empty(0, dtype=np.int64), *excused]),
        )

    def _assembled(self, solutions: list[ChartSolution], where: PlaceOptions) -> Unwrapped:
        """Place the disks and gather the corners' coordinates."""
        mapped = np.array([solution.map is not None for solution in solutions])
        image_area = np.array([0.5 * np.abs(solution.signed).sum() for solution in solutions])
        outlines = self._outlines(solutions)
        found = iter(placements(where.place, where.margin, self._meshes.area[mapped], image_area[mapped], outlines))
        placed = [next(found) if done else Placement() for done in mapped.tolist()]
        surface, split = self._split.surface, self._split
        z: NDArray[np.complex128] = np.zeros(len(surface.vertex_of_site), dtype=np.complex128)
        for number in np.flatnonzero(mapped).tolist():
            own = slice(self._meshes.first_vertex[number], self._meshes.first_virtual[number])
            z[self._meshes.site[own]] = _laid(solutions[number].z, placed[number])
        uv = np.zeros((self._corner_count, 2))
        uv[split.corner] = z[surface.site[: len(split.corner)]].view(np.float64).reshape(-1, 2)
        chart_of_face = np.full(self._face_count, -1, dtype=np.int64)
        chart_of_face[split.selected] = surface.chart[: surface.real]
        done = np.append(mapped, False)[chart_of_face]
        return Unwrapped(uv, chart_of_face, done, self._charts(solutions, placed))

    def _outlines(self, solutions: list[ChartSolution]) -> list[Outline] | None:
        """Positions and triangles that cover each mapped chart, of disks the whole disk; None where all are disks."""
        done = [(number, one) for number, one in enumerate(solutions) if one.map is not None]
        if all(isinstance(one.map, DiskMap) for _, one in done):
            return None
        return [
            unit_disk() if isinstance(one.map, DiskMap) else (one.z, self._meshes[number].F.T) for number, one in done
        ]

    def _charts(self, solutions: list[ChartSolution], placed: list[Placement]) -> list[Chart]:
        split, meshes = self._split, self._meshes
        faces = split.selected[np.argsort(split.surface.chart[: split.surface.real], kind="stable")]
        first = np.concatenate(([0], np.cumsum(np.bincount(split.surface.chart[: split.surface.real]))))
        charts = []
        for number, solution in enumerate(solutions):
            mesh = self._mappers[number].mesh
            polygon = split.selected[meshes.polygon[meshes.first_face[number] : meshes.first_face[number + 1]]]
            charts.append(
                Chart(
                    faces=faces[first[number] : first[number + 1]],
                    error=solution.error,
                    map=solution.map,
                    vertices=mesh.vertices,
                    F=mesh.F,
                    polygon=polygon,
                    corner=split.corner[mesh.corner],
                    flipped=self._flipped(solution, mesh),
                    notes=split.notes.get(number, []) + solution.notes,
                    placement=placed[number],
                    mesh=mesh,
                )
            )
        return charts

    def _flipped(self, solution: ChartSolution, mesh: ChartMesh) -> NDArray[np.int64]:
        """The caller's polygons with an inverted or collapsed triangle among those that were solved on."""
        if solution.map is None or not len(solution.map.flipped):
            return np.empty(0, dtype=np.int64)
        polygon = np.unique(mesh.solved_polygon[solution.map.flipped])
        return self._split.selected[polygon[polygon < self._split.surface.real]]


def _laid(z: NDArray[np.complex128], placement: Placement) -> NDArray[np.complex128]:
    """Positions put in their place; untouched where there is nothing to do."""
    if placement == Placement():
        return z
    return complex(*placement.center) + placement.scale * z
