"""The numbers of one map or of many, computed once: what the commands, Blender and pymeshlab show."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .charts import Chart, Placement, Unwrapped
from .mesh.polygons import PolygonMesh
from .mesh.triangulate import triangulate
from .operators import Distortion
from .operators.orientation_sign import orientation_signs
from .operators.wirtinger import planar_sides, signed_double_areas

__all__ = [
    "DistortionNumbers",
    "UnwrapNumbers",
    "coverage",
    "distortion_numbers",
    "flipped_polygons",
    "unwrap_numbers",
]

BEYOND = 1e-6  # of the square's side: what single precision takes may lie out of it


@dataclass(frozen=True)
class DistortionNumbers:
    """Distortion over all triangles of some maps.

    Attributes
    ----------
    angle_mean, angle_rms, angle_sd, angle_max : float
        Of the angle error at all corners, degrees: mean, root mean square, standard deviation, largest.
    quasi_conformal_median, quasi_conformal_max : float
        Of the ratio of singular values; infinite where a triangle or its image has no area.
    area_ratio : float or None
        Largest over smallest change of area, of the triangles that have one.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> square, F = [[0, 0], [1, 0], [0, 1]], [[0, 1, 2]]
    >>> cuv.distortion_numbers([cuv.distortion(square, F, square)]).angle_max
    0.0
    """

    angle_mean: float
    angle_rms: float
    angle_sd: float
    angle_max: float
    quasi_conformal_median: float
    quasi_conformal_max: float
    area_ratio: float | None


@dataclass(frozen=True, eq=False)
class UnwrapNumbers:
    """What came of an unwrap, over all its charts or some of them.

    Attributes
    ----------
    charts, mapped_charts, converged_charts : int
    triangles : int
        Of the charts, mapped or not.
    vertices : int
        The caller's, in these charts.
    distortion : DistortionNumbers or None
        Of the mapped charts, as stored; None where there are none.
    conformal_energy, dirichlet_energy : float
        Sums over the mapped charts.
    flipped : (k,) int64
        The caller's polygons with a triangle of non-positive area.
    lost_to_double : int
    lost_to_float32 : (c,) int64
        Triangles of each chart without positive area in single precision, as stored.
    coverage : float or None
        Share of the unit square that the images fill, as stored; None where they were not placed in it.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> from conformal_uv.samples import mask
    >>> numbers = cuv.unwrap_numbers(cuv.unwrap(*mask(500)))
    >>> numbers.charts, numbers.vertices, len(numbers.flipped), numbers.lost_to_float32.tolist()
    (1, 500, 0, [0])
    """

    charts: int
    mapped_charts: int
    converged_charts: int
    triangles: int
    vertices: int
    distortion: DistortionNumbers | None
    conformal_energy: float
    dirichlet_energy: float
    flipped: NDArray[np.int64]
    lost_to_double: int
    lost_to_float32: NDArray[np.int64]
    coverage: float | None


def distortion_numbers(
    distortions: Sequence[Distortion], area_factors: Sequence[float] | None = None
) -> DistortionNumbers:
    """The numbers of several maps together, at least one.

    Parameters
    ----------
    area_factors : sequence of float, optional
        By which the areas of each image were multiplied after its distortion was measured.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> V = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    >>> d = cuv.distortion(V, [[0, 1, 2]], [[0, 0], [2, 0], [0, 1]])
    >>> cuv.distortion_numbers([d]).quasi_conformal_max
    2.0
    """
    error = np.concatenate([d.angle_error.reshape(-1) for d in distortions])
    ratio = np.concatenate([d.quasi_conformal for d in distortions])
    factors = area_factors if area_factors is not None else [1.0] * len(distortions)
    area = np.concatenate([d.area_scale * factor for d, factor in zip(distortions, factors, strict=True)])
    area = area[np.isfinite(area) & (area > 0.0)]
    return DistortionNumbers(
        angle_mean=float(error.mean()),
        angle_rms=float(np.sqrt(np.mean(error * error))),
        angle_sd=float(error.std()),
        angle_max=float(error.max()),
        quasi_conformal_median=float(np.median(ratio)),
        quasi_conformal_max=float(ratio.max()),
        area_ratio=float(area.max() / area.min()) if len(area) else None,
    )


def unwrap_numbers(
    result: Unwrapped, *, uv: NDArray[np.float64] | None = None, chosen: NDArray[np.bool_] | None = None
) -> UnwrapNumbers:
    """The numbers of an unwrapped mesh.

    Parameters
    ----------
    uv : (k, 2) floats, optional
        Coordinates as they are stored, where the caller has moved its islands; by default ``result.uv``.
    chosen : (c,) bool, optional
        The charts whose maps count, mapped ones; by default all that were mapped.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> from conformal_uv.samples import mask
    >>> numbers = cuv.unwrap_numbers(cuv.unwrap(*mask(500)))
    >>> numbers.mapped_charts, numbers.distortion.angle_mean < numbers.distortion.angle_rms
    (1, True)
    """
    stored = result.uv if uv is None else uv
    taken = [chart.map is not None for chart in result.charts] if chosen is None else chosen.tolist()
    done = [chart for chart, take in zip(result.charts, taken, strict=True) if take]
    maps = [chart.map for chart in done if chart.map is not None]
    distortions = [chart.distortion for chart in done if chart.distortion is not None]
    empty = np.empty(0, dtype=np.int64)
    return UnwrapNumbers(
        charts=len(result.charts),
        mapped_charts=len(done),
        converged_charts=sum(found.converged for found in maps),
        triangles=sum(len(chart.F) for chart in result.charts),
        vertices=len(np.unique(np.concatenate([empty, *(chart.vertices for chart in result.charts)]))),
        distortion=distortion_numbers(distortions, [_enlarged(chart, stored) for chart in done]) if done else None,
        conformal_energy=sum(found.conformal_energy for found in maps),
        dirichlet_energy=sum(found.dirichlet_energy for found in maps),
        flipped=np.concatenate([empty, *(chart.flipped for chart in done)]),
        lost_to_double=sum(len(found.lost_to_double) for found in maps),
        lost_to_float32=np.where(taken, result.lost_to_float32(stored), 0),
        coverage=coverage(stored, done)
        if uv is not None or any(chart.placement != Placement() for chart in done)
        else None,
    )


def coverage(uv: NDArray[np.float64], charts: Sequence[Chart]) -> float | None:
    """Share of the unit square that charts without overlaps fill; None where one reaches out of it.

    Parameters
    ----------
    uv : (k, 2) floats
        Of every polygon corner.
    charts : sequence of Chart
        Mapped ones.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> from conformal_uv.samples import mask
    >>> u = cuv.unwrap(*mask(500))
    >>> 0.77 < cuv.unwrap_numbers(u).coverage < 0.7854  # a disk that fills the square
    True
    """
    used = [uv[chart.corner] for chart in charts]
    if not used or min(part.min() for part in used) < -BEYOND or max(part.max() for part in used) > 1.0 + BEYOND:
        return None
    return sum(_area(uv, chart.corner) for chart in charts)


def _enlarged(chart: Chart, stored: NDArray[np.float64]) -> float:
    """Area of the chart in the texture over that in its own plane."""
    assert chart.map is not None
    own = _area(chart.map.uv, chart.F)
    return _area(stored, chart.corner) / own if own > 0.0 else 1.0


def _area(uv: NDArray[np.float64], triangles: NDArray[np.int64]) -> float:
    z = np.ascontiguousarray(uv, dtype=np.float64).view(np.complex128).reshape(-1)
    return 0.5 * float(np.abs(signed_double_areas(planar_sides(z, triangles.T.astype(np.int32)))).sum())


def flipped_polygons(mesh: PolygonMesh, corner_uv: NDArray[np.floating]) -> NDArray[np.int64]:
    """Polygons with a triangle of non-positive area in texture coordinates, by exact signs of the numbers given.

    Parameters
    ----------
    mesh : PolygonMesh
    corner_uv : (k, 2)
        Coordinates of each polygon corner, in single or double precision; what is not finite counts as 0.

    Returns
    -------
    (q,) int64, ascending

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> mesh = cuv.PolygonMesh(np.eye(3), np.array([0, 1, 2]), np.array([0, 3]))
    >>> cuv.flipped_polygons(mesh, [[0, 0], [0, 1], [1, 0]]).tolist()
    [0]
    """
    _, polygon, corner = triangulate(mesh)
    uv = np.nan_to_num(np.asarray(corner_uv, dtype=np.float64))
    signs = orientation_signs(uv, np.ascontiguousarray(corner.T.astype(np.int32)))
    return np.unique(polygon[signs <= 0])
