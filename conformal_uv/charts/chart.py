"""What is known of a chart after it was mapped."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import ConformalUVError
from ..operators import Distortion, distortion
from .chart_mapper import ShapeMap
from .chart_meshes import ChartMesh
from .packing import Placement

__all__ = ["Chart"]


@dataclass(frozen=True, eq=False)
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

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> (chart,) = cuv.unwrap([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]]).charts
    >>> chart.status, chart.faces.tolist(), chart.F.tolist(), chart.scale
    ('mapped', [0], [[0, 1, 2], [0, 2, 3]], 0.5)
    """

    faces: NDArray[np.int64]
    error: ConformalUVError | None
    map: ShapeMap | None
    vertices: NDArray[np.int64]
    F: NDArray[np.int64]
    polygon: NDArray[np.int64]
    corner: NDArray[np.int64]
    flipped: NDArray[np.int64]
    notes: list[str]
    placement: Placement
    mesh: ChartMesh = field(repr=False)

    @property
    def status(self) -> Literal["mapped", "failed"]:
        """Whether the chart was mapped."""
        return "failed" if self.map is None else "mapped"

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
