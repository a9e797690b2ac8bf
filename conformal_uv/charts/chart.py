"""What is known of a chart after it was mapped."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import ConformalUVError
from ..operators import Distortion, distortion
from .chart_mapper import ShapeMap
from .chart_meshes import ChartMesh
from .packing import Placement

if TYPE_CHECKING:
    from .chart_list import ChartList

__all__ = ["Chart"]

Ints = NDArray[np.int64]


class Chart:
    """A part of the surface with a disk of its own.

    Attributes
    ----------
    faces : (q,) int64
        The caller's polygons.
    error : ConformalUVError or None
        Why the chart was not mapped; indices in it are the caller's.
    map : DiskMap, FreeMap, RectangleMap or None
        In the chart's own vertices; rows of ``map.uv`` beyond ``len(vertices)`` are virtual vertices in the middle
        of filled holes. Disks are turned upright and by `rotation` there; nothing is placed.
    vertices : (n,) int64
        The caller's vertex of each chart vertex; a vertex on both sides of a cut stands twice.
    F : (m, 3) int64
        The chart's own triangles (polygons cut into triangles, holes not filled), in chart vertices.
    polygon : (m,) int64
        The caller's polygon of each of these.
    corner : (m, 3) int64
        The caller's polygon corner at each corner of these, a row of ``Unwrapped.uv``.
    flipped : (k,) int64
        The caller's polygons with a triangle whose image has non-positive signed area.
    notes : list of str
        What was mended, cut, filled or left unused.
    placement : Placement
        Center and scale of the disk in the texture.
    mesh : ChartMesh
        What was solved on.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> (chart,) = cuv.unwrap([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]]).charts
    >>> chart.status, chart.faces.tolist(), chart.F.tolist(), chart.scale
    ('mapped', [0], [[0, 1, 2], [0, 2, 3]], 0.5)
    """

    def __init__(self, charts: ChartList, number: int) -> None:
        self._all, self._number = charts, number

    def __repr__(self) -> str:
        return f"Chart(number={self._number}, faces={len(self.faces)}, status={self.status!r})"

    @property
    def faces(self) -> Ints:
        """See Chart."""
        return self._all.faces_of(self._number)

    @property
    def error(self) -> ConformalUVError | None:
        """See Chart."""
        return self._all.errors.get(self._number)

    @cached_property
    def map(self) -> ShapeMap | None:
        """See Chart."""
        return self._all.solutions.map(self._number)

    @cached_property
    def mesh(self) -> ChartMesh:
        """See Chart."""
        return self._all.meshes[self._number]

    @property
    def vertices(self) -> Ints:
        """See Chart."""
        return self.mesh.vertices

    @property
    def F(self) -> Ints:
        """See Chart."""
        return self.mesh.F

    @property
    def polygon(self) -> Ints:
        """See Chart."""
        return self._all.split.selected[self.mesh.polygon]

    @property
    def corner(self) -> Ints:
        """See Chart."""
        return self._all.split.corner[self.mesh.corner]

    @cached_property
    def flipped(self) -> Ints:
        """See Chart; triangles that were solved on count."""
        if self.map is None or not len(self.map.flipped):
            return np.empty(0, dtype=np.int64)
        split = self._all.split
        polygon = np.unique(self.mesh.solved_polygon[self.map.flipped])
        return split.selected[polygon[polygon < split.surface.real]]

    @property
    def notes(self) -> list[str]:
        """See Chart."""
        return self._all.notes_of(self._number)

    @property
    def placement(self) -> Placement:
        """See Chart."""
        return self._all.placed.of(self._number)

    @property
    def status(self) -> Literal["mapped", "failed"]:
        """Whether the chart was mapped."""
        return "mapped" if self._all.mapped[self._number] else "failed"

    @property
    def scale(self) -> float:
        """Radius of the chart's disk in the texture."""
        return self.placement.scale

    @cached_property
    def distortion(self) -> Distortion | None:
        """Distortion of the map in the unit disk on the triangles F; None for a chart that failed."""
        if self.map is None:
            return None
        n = len(self.vertices)
        return distortion(self.mesh.V[:n], self.F, self.map.uv[:n])
