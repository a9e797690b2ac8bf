"""The numbers of one map or of many, computed once: what the commands, Blender and pymeshlab show."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .charts import ChartList, Unwrapped
from .concise import Concise
from .disk import DiskMap
from .free import FreeMap
from .mesh.polygons import PolygonMesh
from .mesh.triangulate import triangulate
from .operators import Distortion, distortion
from .operators.orientation_sign import orientation_signs
from .rectangle import RectangleMap

__all__ = [
    "DistortionNumbers",
    "UnwrapNumbers",
    "distortion_numbers",
    "flipped_polygons",
    "polygon_angle_errors",
    "shape_name",
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


@dataclass(frozen=True, eq=False, repr=False)
class UnwrapNumbers(Concise):
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
    stored = np.asarray(result.uv if uv is None else uv, dtype=np.float64)
    charts, solutions = result.charts, result.charts.solutions
    taken = charts.mapped if chosen is None else np.asarray(chosen, dtype=bool)
    done = np.flatnonzero(taken)
    conformal, dirichlet = solutions.energies()
    image = charts.image_areas(stored)
    placed = uv is not None or charts.placed.moved(done)
    return UnwrapNumbers(
        charts=len(charts),
        mapped_charts=len(done),
        converged_charts=int(solutions.converged[done].sum()),
        triangles=len(charts.corner),
        vertices=charts.meshes.used_vertices(),
        distortion=_joined_numbers(charts, taken, image) if len(done) else None,
        conformal_energy=float(conformal[done].sum()),
        dirichlet_energy=float(dirichlet[done].sum()),
        flipped=charts.flipped(done),
        lost_to_double=int(solutions.lost_to_double()[done].sum()),
        lost_to_float32=np.where(taken, result.lost_to_float32(stored), 0),
        coverage=_coverage(charts, taken, stored, image) if placed else None,
    )


def _joined_numbers(charts: ChartList, taken: NDArray[np.bool_], image: NDArray[np.float64]) -> DistortionNumbers:
    """Of all triangles of the charts taken (c,); their areas as stored."""
    found, own = charts.distortion(taken)
    plane = charts.solutions.image_areas()
    enlarged = np.divide(image, plane, out=np.ones(len(plane)), where=plane > 0.0)
    return distortion_numbers([replace(found, area_scale=found.area_scale * enlarged[charts.chart_of_triangle[own]])])


def _coverage(
    charts: ChartList, taken: NDArray[np.bool_], uv: NDArray[np.float64], image: NDArray[np.float64]
) -> float | None:
    """Share of the unit square that charts without overlaps fill; None where one reaches out of it."""
    used = uv[charts.corner[taken[charts.chart_of_triangle]]]
    if not used.size or used.min() < -BEYOND or used.max() > 1.0 + BEYOND:
        return None
    return float(image[taken].sum())


def shape_name(result: DiskMap | FreeMap | RectangleMap) -> str:
    """The name of a map for people: its method on the disk, else its shape."""
    if isinstance(result, FreeMap):
        return "free"
    return "rectangle" if isinstance(result, RectangleMap) else result.method


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


def polygon_angle_errors(mesh: PolygonMesh, corner_uv: NDArray[np.floating]) -> NDArray[np.float64]:
    """The largest angle error at the corners of each polygon's triangles, in texture coordinates as they are.

    Parameters
    ----------
    mesh : PolygonMesh
    corner_uv : (k, 2)
        Coordinates of each polygon corner; what is not finite, of these or of the vertices, counts as 0.

    Returns
    -------
    (p,) float64, degrees
        0 for a polygon that can not be cut into triangles.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> mesh = cuv.PolygonMesh(np.eye(3), np.array([0, 1, 2]), np.array([0, 3]))
    >>> cuv.polygon_angle_errors(mesh, [[0, 0], [1, 0], [0, 1]]).round(9).tolist()
    [30.0]
    """
    _, polygon, corner = triangulate(mesh)
    worst = np.zeros(len(mesh.sizes))
    if len(corner):
        V = np.nan_to_num(mesh.V[mesh.corners])
        found = distortion(V, corner, np.nan_to_num(np.asarray(corner_uv, dtype=np.float64)))
        np.maximum.at(worst, polygon, found.angle_error.max(axis=1))
    return worst
