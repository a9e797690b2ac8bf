"""What is known of a chart after it was mapped, and of all of them together."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import ConformalUVError, Remedy, listed
from ..operators import Distortion, distortion
from ..operators.orientation_sign import orientation_signs
from .chart_mapper import ShapeMap
from .chart_meshes import ChartMesh
from .packing import Placement

__all__ = ["Chart", "Unwrapped"]

MOST_REASONS = 8


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


@dataclass(frozen=True, eq=False)
class Unwrapped:
    """Texture coordinates on the caller's own polygons.

    Attributes
    ----------
    uv : (k, 2) float64
        Of every polygon corner, polygon after polygon in the caller's order; 0 where nothing was mapped.
    chart_of_face : (p,) int64
        -1 for polygons that were not selected.
    mapped : (p,) bool
        Polygons whose corners have coordinates.
    charts : list of Chart
        In the order of their first polygons.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> u = cuv.unwrap([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]], rotation=0.0)
    >>> u.uv.shape, u.mapped.tolist(), bool((u.uv >= 0.0).all() and (u.uv <= 1.0).all())
    ((4, 2), [True], True)
    """

    uv: NDArray[np.float64]
    chart_of_face: NDArray[np.int64]
    mapped: NDArray[np.bool_]
    charts: list[Chart]

    def lost_to_float32(self, uv: NDArray[np.float64] | None = None) -> NDArray[np.int64]:
        """Number of each chart's triangles without positive area where coordinates are kept in single precision.

        That is what textures and modelling programs keep, of islands where they lie; triangles that are folded in
        double precision count too. 0 for charts that failed; (c,) for c charts.

        Parameters
        ----------
        uv : (k, 2) floats, optional
            Coordinates as they are stored, where the caller has moved its islands; by default ``self.uv``.
        """
        sizes = [len(chart.corner) if chart.map is not None else 0 for chart in self.charts]
        corner = [chart.corner for chart in self.charts if chart.map is not None]
        owner = np.repeat(np.arange(len(sizes)), sizes)
        if not corner:
            return np.zeros(len(sizes), dtype=np.int64)
        stored = np.asarray(self.uv if uv is None else uv).astype(np.float32).astype(np.float64)
        lost = orientation_signs(stored, np.concatenate(corner).T.astype(np.int32)) <= 0
        return np.bincount(owner[lost], minlength=len(sizes))

    @property
    def summary(self) -> str:
        """How many charts were mapped, and why the others were not, in one line."""
        return self.told()

    def told(self, words: Callable[[Remedy], str] | None = None) -> str:
        """The same, remedies in the words of where it is shown; see `ConformalUVError.told`."""
        failed = [(number, chart) for number, chart in enumerate(self.charts) if chart.error is not None]
        done = len(self.charts) - len(failed)
        text = f"mapped {done} of {len(self.charts)} chart{'s' * (len(self.charts) != 1)}"
        reasons = [
            f"chart {number} (faces {listed(chart.faces)}): {chart.error.told(words)}"
            for number, chart in failed
            if chart.error is not None
        ]
        if len(reasons) > MOST_REASONS:
            reasons[MOST_REASONS:] = [f"and {len(failed) - MOST_REASONS} more"]
        return "; ".join([text, *reasons])

    def failure(self, words: Callable[[Remedy], str] | None = None) -> ConformalUVError | None:
        """One error for all charts where none was mapped, of their class where they have one; else None."""
        errors = [chart.error for chart in self.charts if chart.error is not None]
        if self.mapped.any() or not errors:
            return None
        if len(errors) == 1:
            return errors[0]
        kinds = {type(error) for error in errors}
        kind = kinds.pop() if len(kinds) == 1 else ConformalUVError
        return kind(self.told(words), [index for error in errors for index in error.indices])
