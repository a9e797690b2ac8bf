"""One chart mapped to the unit disk, its errors told in the caller's numbers."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..disk import DiskMap, DiskMapper
from ..errors import ConformalUVError, DegenerateFaceError, MeshError, Remedy, SolverError, listed
from ..operators.wirtinger import planar_sides, signed_double_areas
from ..options import DiskOptions, Laplacian
from ..progress import Callback
from .chart_meshes import ChartMesh
from .named_vertices import NamedVertices, vertices_used

__all__ = ["ChartMapper", "ChartSolution"]


@dataclass(frozen=True, eq=False)
class ChartSolution:
    """The map of a chart or the error; `z` (n,) positions of its own vertices, `signed` twice the image's area of
    its own triangles (m,), `used` the caller's vertices that its options took."""

    map: DiskMap | None
    error: ConformalUVError | None
    notes: list[str]
    z: NDArray[np.complex128]
    signed: NDArray[np.float64]
    used: dict[str, NDArray[np.int64]] = field(default_factory=dict)


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
        self._mapper: DiskMapper | None = None

    def solve(self, options: DiskOptions, vertices: NamedVertices, callback: Callback | None) -> ChartSolution:
        """Map the chart; what is wrong with the chart comes back as its error.

        Raises
        ------
        OptionError, MissingDependencyError, CancelledError
        """
        if self._error is None:
            try:
                return self._solution(options, vertices, callback)
            except (MeshError, SolverError) as error:
                return _failed(self._told(error))
        return _failed(self._error)

    def _solution(self, options: DiskOptions, vertices: NamedVertices, callback: Callback | None) -> ChartSolution:
        mesh = self.mesh
        if self._mapper is None:
            self._mapper = DiskMapper(
                mesh.V, mesh.solved, laplacian=self._laplacian, backend=self._backend, callback=callback
            )
        own, notes = vertices.of_chart(options, mesh.vertices, self._mapper.boundary)
        found = self._mapper.solved(own, callback)
        z = np.ascontiguousarray(found.uv).view(np.complex128).reshape(-1)[: len(mesh.vertices)]
        signed = signed_double_areas(planar_sides(z, mesh.F.T.astype(np.int32)))
        return ChartSolution(found, None, notes, z, signed, vertices_used(own, mesh.vertices))

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


def _failed(error: ConformalUVError) -> ChartSolution:
    return ChartSolution(None, error, [], np.empty(0, dtype=np.complex128), np.empty(0))
