"""Charts of several results packed into one unit square."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..options import PlaceOptions
from .chart_list import ChartList
from .outlines import Outlines, joint_outlines, unit_disk
from .packing import ChartShape, Placements, placements
from .unwrapped import Unwrapped

__all__ = ["pack_together"]


def pack_together(
    results: Sequence[Unwrapped],
    wanted: Sequence[NDArray[np.bool_]],
    margin: float | None = None,
    **options: Any,
) -> list[NDArray[np.float64]]:
    """Texture coordinates of several meshes whose charts share one unit square.

    Areas of images are to areas of surfaces as one number to all; a chart alone fills the square.

    Parameters
    ----------
    results : sequence of Unwrapped
        Made with ``place="disk"``.
    wanted : sequence of (c,) bool
        The charts of each result that are to be placed, mapped ones; those that pinned corners hold stay.
    margin : float, optional
        Between charts and to the sides, as in `unwrap`.
    margin_method, image_size, pack_rotation, pack_shape, keep_scale, tile
        As in `unwrap`.

    Returns
    -------
    list of (k, 2) float64
        Of every polygon corner of each result; others than the wanted charts' as they are in the disk.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> from conformal_uv.samples import mask
    >>> results = [cuv.unwrap(*mask(n), place="disk") for n in (200, 300)]
    >>> one, other = cuv.pack_together(results, [[True], [True]])
    >>> bool(min(one.min(), other.min()) >= 0.0 and max(one.max(), other.max()) <= 1.0)
    True
    """
    where = PlaceOptions(margin=margin, **options)
    lists = [result.charts for result in results]
    taken = [np.flatnonzero(mask & ~charts.held) for mask, charts in zip(wanted, lists, strict=True)]
    area = np.concatenate([charts.surface_areas()[own] for charts, own in zip(lists, taken, strict=True)])
    largest = 1.0 if where.keep_scale else float(area.max(initial=0.0))
    image = [charts.image_areas(result.uv)[own] for result, charts, own in zip(results, lists, taken, strict=True)]
    shapes = _shapes(results, taken)
    placed = placements(where, area / largest if largest > 0.0 else area, np.concatenate(image), shapes)
    out, first = [], 0
    for result, charts, own in zip(results, lists, taken, strict=True):
        here = Placements.untouched(len(charts))
        here.put(own, placed.part(slice(first, first + len(own))))
        moved = np.zeros(len(charts), dtype=bool)
        moved[own] = True
        inside = moved[charts.chart_of_triangle]
        corner, chart = charts.corner[inside], charts.chart_of_triangle[inside][:, None]
        uv = result.uv.copy()
        z = here.placed(result.uv[corner].view(np.complex128)[..., 0], chart)
        uv[corner] = np.stack((z.real, z.imag), axis=2)
        out.append(uv)
        first += len(own)
    return out


def _shapes(results: Sequence[Unwrapped], taken: list[NDArray[np.int64]]) -> Outlines | list[ChartShape] | None:
    """What covers some charts of each result; None where all are disks."""
    disks = np.concatenate([one.charts.solutions.is_disk[own] for one, own in zip(results, taken, strict=True)])
    if disks.all():
        return None
    if disks.any():
        return [
            _shape(one.charts, number, one.uv)
            for one, own in zip(results, taken, strict=True)
            for number in own.tolist()
        ]
    positions, corners, owners, first, before = [], [], [], 0, 0
    for one, own in zip(results, taken, strict=True):
        charts = one.charts
        number = np.full(len(charts), -1)
        number[own] = before + np.arange(len(own))
        owner = number[charts.chart_of_triangle]
        inside, uv = owner >= 0, np.ascontiguousarray(one.uv).view(np.complex128)[:, 0]
        vertex, z = charts.meshes.F_of_all[inside], np.zeros(len(charts.meshes.V), dtype=np.complex128)
        z[vertex] = uv[charts.corner[inside]]
        positions.append(z)
        corners.append(vertex.T + first)
        owners.append(owner[inside])
        first, before = first + len(z), before + len(own)
    return joint_outlines(np.concatenate(positions), np.concatenate(corners, axis=1), np.concatenate(owners))


def _shape(charts: ChartList, number: int, uv: NDArray[np.float64]) -> ChartShape:
    """Positions and triangles that cover the chart: those of the whole disk, or its own."""
    if charts.solutions.is_disk[number]:
        return unit_disk()
    own, triangles = np.unique(charts[number].corner, return_inverse=True)
    return np.ascontiguousarray(uv[own]).view(np.complex128).reshape(-1), triangles.reshape(-1, 3).T
