"""Charts of several results packed into one unit square."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..disk import DiskMap
from ..operators import face_areas
from ..operators.wirtinger import planar_sides, signed_double_areas
from ..options import Place
from .chart import Chart, Unwrapped
from .outlines import unit_disk
from .packing import placements

__all__ = ["pack_together"]


def pack_together(
    results: Sequence[Unwrapped], wanted: Sequence[NDArray[np.bool_]], margin: float | None = None
) -> list[NDArray[np.float64]]:
    """Texture coordinates of several meshes whose charts share one unit square.

    Areas of images are to areas of surfaces as one number to all; a chart alone fills the square.

    Parameters
    ----------
    results : sequence of Unwrapped
        Made with ``place="disk"``.
    wanted : sequence of (c,) bool
        The charts of each result that are to be placed, mapped ones.
    margin : float, optional
        Between disks and to the sides, as in `unwrap`.

    Returns
    -------
    list of (k, 2) float64
        Of every polygon corner of each result; others than the wanted charts' as they are in the disk.

    Raises
    ------
    MissingDependencyError
        There are several charts and rectangle-packer is not installed.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> from conformal_uv.samples import mask
    >>> results = [cuv.unwrap(*mask(n), place="disk") for n in (200, 300)]
    >>> one, other = cuv.pack_together(results, [[True], [True]])
    >>> bool(min(one.min(), other.min()) >= 0.0 and max(one.max(), other.max()) <= 1.0)
    True
    """
    charts = [(number, chart) for number, chart in _chosen(results, wanted)]
    area = np.array([face_areas(chart.mesh.V, chart.F).sum() for _, chart in charts])
    largest = float(area.max(initial=0.0))
    image = np.array([_image_area(chart, results[number].uv) for number, chart in charts])
    shapes = None
    if not all(isinstance(chart.map, DiskMap) for _, chart in charts):
        shapes = [_shape(chart, results[number].uv) for number, chart in charts]
    placed = placements(Place.FIT, margin, area / largest if largest > 0.0 else area, image, shapes)
    out = [result.uv.copy() for result in results]
    for (number, chart), place in zip(charts, placed, strict=True):
        own = np.unique(chart.corner)
        out[number][own] = np.asarray(place.center) + place.scale * results[number].uv[own]
    return out


def _chosen(results: Sequence[Unwrapped], wanted: Sequence[NDArray[np.bool_]]) -> list[tuple[int, Chart]]:
    return [
        (number, chart)
        for number, (result, mask) in enumerate(zip(results, wanted, strict=True))
        for chart, take in zip(result.charts, mask, strict=True)
        if take
    ]


def _shape(chart: Chart, uv: NDArray[np.float64]) -> tuple[NDArray[np.complex128], NDArray[np.int64]]:
    """Positions and triangles that cover the chart: those of the whole disk, or its own."""
    if isinstance(chart.map, DiskMap):
        return unit_disk()
    own, triangles = np.unique(chart.corner, return_inverse=True)
    return np.ascontiguousarray(uv[own]).view(np.complex128).reshape(-1), triangles.reshape(-1, 3).T


def _image_area(chart: Chart, uv: NDArray[np.float64]) -> float:
    z = np.ascontiguousarray(uv).view(np.complex128).reshape(-1)
    return 0.5 * float(np.abs(signed_double_areas(planar_sides(z, chart.corner.T.astype(np.int32)))).sum())
