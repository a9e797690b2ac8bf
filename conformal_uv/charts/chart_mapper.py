"""One chart mapped to its shape, its errors told in the caller's numbers."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..disk import DiskMap, DiskMapper
from ..errors import ConformalUVError, DegenerateFaceError, MeshError, Remedy, SolverError, listed
from ..free import FreeMap, PinnedMapper, mapped_free
from ..operators.factorized_disk import FactorizedDisk
from ..operators.wirtinger import planar_sides, signed_double_areas
from ..options import ChartOptions, FreeOptions, Laplacian, Shape
from ..progress import Callback, Progress
from ..rectangle import RectangleMap, mapped_rectangle
from .chart_meshes import ChartMesh
from .named_vertices import NamedVertices, vertices_used
from .pinned_corners import ChartPins
from .upright import upright_turn

__all__ = ["ChartMapper", "ChartSolution", "ShapeMap"]

ShapeMap = DiskMap | FreeMap | RectangleMap
Used = dict[str, NDArray[np.int64]]
Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class ChartSolution:
    """The map of a chart or the error.

    `z` (n,) are positions of its own vertices, turned upright: in the unit disk, of other shapes in the middle of the
    square [-1, 1]^2 that they fill one way, of `held` ones where their pins are; `signed` is twice the image's area of
    its own triangles (m,) there, `used` are the caller's vertices that its options took.
    """

    map: ShapeMap | None
    error: ConformalUVError | None
    notes: list[str]
    z: NDArray[np.complex128]
    signed: NDArray[np.float64]
    used: Used = field(default_factory=dict)
    held: bool = False


class ChartMapper:
    """A chart whose factorization is kept.

    Parameters
    ----------
    mesh : ChartMesh
    name : (q,) int64
        The caller's index of each polygon.
    error : ConformalUVError or None
        What is already known to be wrong.
    """

    def __init__(
        self, mesh: ChartMesh, name: NDArray[np.int64], error: ConformalUVError | None, laplacian: str, backend: str
    ) -> None:
        self.mesh, self._name, self._error = mesh, name, error
        self._laplacian, self._backend = laplacian, backend
        self._factorized: FactorizedDisk | None = None
        self._disk: DiskMapper | None = None
        self._pinned: PinnedMapper | None = None

    def solve(
        self,
        shape: Shape,
        options: ChartOptions,
        vertices: NamedVertices,
        callback: Callback | None,
        pins: ChartPins | None = None,
    ) -> ChartSolution:
        """Map the chart, where there are `pins` with these where they are; what is wrong comes back as its error.

        Raises
        ------
        OptionError, MissingDependencyError, CancelledError
        """
        if self._error is not None:
            return _failed(self._error)
        try:
            if pins is not None:
                return self._held(*pins, vertices, callback)
            found, used, notes = self._mapped(shape, options, vertices, callback)
        except (MeshError, SolverError) as error:
            return _failed(self._told(error))
        z = self._framed(found, shape, options, fixed=vertices.ordered and bool(len(used["pins"])))
        return ChartSolution(map=found, error=None, notes=notes, z=z, signed=self._signed(z), used=used)

    def _held(
        self, pins: NDArray[np.int64], places: NDArray[np.float64], vertices: NamedVertices, callback: Callback | None
    ) -> ChartSolution:
        """The least squares conformal map with vertices of the chart at their places."""
        factorized, own = self._checked(callback), self.mesh.vertices
        if self._pinned is None or not np.array_equal(self._pinned.pins, pins):
            self._pinned = PinnedMapper.of(factorized, pins, Progress(callback))
        found = self._pinned.map(places)
        z = np.ascontiguousarray(found.uv).view(np.complex128).reshape(-1)[: len(own)]
        notes = vertices.of_free(own) + _crossings_told(found)
        used = vertices_used(FreeOptions(), own)
        return ChartSolution(map=found, error=None, notes=notes, z=z, signed=self._signed(z), used=used, held=True)

    def _signed(self, z: Complex) -> NDArray[np.float64]:
        return signed_double_areas(planar_sides(z, self.mesh.F.T.astype(np.int32)))

    def _mapped(
        self, shape: Shape, options: ChartOptions, vertices: NamedVertices, callback: Callback | None
    ) -> tuple[ShapeMap, Used, list[str]]:
        """The map, the caller's vertices that it used, and what is to be said."""
        factorized, own = self._checked(callback), self.mesh.vertices
        if shape is Shape.FREE:
            notes = vertices.of_free(own)
            free = mapped_free(factorized, options.free, Progress(callback))
            return free, vertices_used(options.free, own), notes + _crossings_told(free)
        if shape is Shape.RECTANGLE:
            rectangle, notes = vertices.of_rectangle(options.rectangle, own, factorized.boundary)
            return mapped_rectangle(factorized, rectangle, Progress(callback)), vertices_used(rectangle, own), notes
        if self._disk is None:
            self._disk = DiskMapper.of(factorized)
        disk, notes = vertices.of_disk(options.disk, own, factorized.boundary)
        fixed = disk.needs_pins or disk.boundary_vertex is not None
        found = self._disk.solved(disk, callback, lambda z: self._turn(z, factorized.boundary, shape, options, fixed))
        return found, vertices_used(disk, own), notes

    def _checked(self, callback: Callback | None) -> FactorizedDisk:
        if self._factorized is None:
            self._factorized = FactorizedDisk(
                self.mesh.V, self.mesh.solved, laplacian=self._laplacian, backend=self._backend, callback=callback
            )
        return self._factorized

    def _turn(self, z: Complex, loop: NDArray[np.int64], shape: Shape, options: ChartOptions, fixed: bool) -> complex:
        """What positions are multiplied by to be upright, if nothing is `fixed`, and then turned as asked for."""
        mesh, turn = self.mesh, complex(np.exp(1j * options.rotation)) if options.rotation else 1.0
        if fixed:
            return turn
        n = len(mesh.vertices)
        return turn * upright_turn(mesh.V[:n], mesh.F, z[:n], loop, shape, options.shape.upright)

    def _framed(self, found: ShapeMap, shape: Shape, options: ChartOptions, *, fixed: bool) -> Complex:
        """Positions of the chart's own vertices; of other shapes than disks turned, and in their square."""
        z: Complex = np.ascontiguousarray(found.uv).view(np.complex128).reshape(-1)[: len(self.mesh.vertices)]
        if shape is Shape.DISK:
            return z
        z = z * self._turn(z, found.boundary, shape, options, fixed)
        low, high = complex(z.real.min(), z.imag.min()), complex(z.real.max(), z.imag.max())
        side = max((high - low).real, (high - low).imag)
        if not side > 0.0:
            return z - low
        z = (z - 0.5 * (low + high)) * (2.0 / side)
        return np.clip(z.real, -1.0, 1.0) + 1j * np.clip(z.imag, -1.0, 1.0)  # rounding goes beyond

    def _told(self, error: ConformalUVError) -> ConformalUVError:
        """The error with the caller's polygons for the chart's triangles.

        Splitting has found everything else that a chart can have against it in the caller's numbers; what is left
        to a map are faces without area, and the solver's errors, which number nothing.
        """
        if not error.indices:
            return error
        polygon = self.mesh.solved_polygon[list(error.indices)] if isinstance(error, DegenerateFaceError) else None
        if polygon is None:
            return type(error)(f"The chart is not a disk that can be mapped ({type(error).__name__}).")
        faces = np.unique(self._name[polygon[polygon < len(self._name)]])
        told = f"{len(faces)} faces have no area: faces {listed(faces)}."
        if len(error.indices) == len(self.mesh.solved):
            return DegenerateFaceError(f"{told} All their vertices lie on one line; there is nothing to map.", faces)
        ways = (Remedy("laplacian", Laplacian.AUTO), "merge their coincident vertices")
        return DegenerateFaceError(told, faces, ways)


def _crossings_told(free: FreeMap) -> list[str]:
    count = len(free.crossings)
    return [f"its boundary crosses itself {count} time{'s' * (count != 1)}"] if count else []


def _failed(error: ConformalUVError) -> ChartSolution:
    return ChartSolution(None, error, [], np.empty(0, dtype=np.complex128), np.empty(0))
