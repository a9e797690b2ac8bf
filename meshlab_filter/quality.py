"""The distortion of every polygon, and the numbers of a whole map."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from conformal_uv import DistortionNumbers, FreeMap, RectangleMap, Unwrapped, unwrap_numbers
from conformal_uv.options import Choice

from .current_mesh import CurrentMesh
from .texcoords import Texcoords

__all__ = ["Quality", "distortion_fields", "map_numbers", "polygon_quality"]


class Quality(Choice):
    """Per-face scalar to write."""

    NONE = "none"
    ANGLE = "angle"
    QUASI_CONFORMAL = "quasi-conformal"


def polygon_quality(result: Unwrapped, quality: Quality) -> NDArray[np.float64]:
    """Mean angle error (degrees) or quasi-conformal ratio of the triangles of each polygon, (p,).

    A ratio without bound (a polygon without area, here or in the image) becomes the largest finite one: MeshLab's
    colour scale can not hold it.
    """
    d, triangle = result.charts.distortion(result.charts.mapped)
    value = d.angle_error.mean(axis=1) if quality is Quality.ANGLE else _bounded(d.quasi_conformal)
    polygon, faces = result.charts.polygon[triangle], len(result.mapped)
    total, count = np.bincount(polygon, value, faces), np.bincount(polygon, minlength=faces)
    return np.asarray(total / np.maximum(count, 1))


def _bounded(ratio: NDArray[np.float64]) -> NDArray[np.float64]:
    finite = ratio[np.isfinite(ratio)]
    return np.minimum(ratio, finite.max() if len(finite) else 1.0)


def map_numbers(source: CurrentMesh, result: Unwrapped, texcoords: Texcoords) -> dict[str, float]:
    """What the filter returns."""
    numbers = unwrap_numbers(result)
    distortion = numbers.distortion
    assert distortion is not None
    return {
        "charts": numbers.charts,
        "mapped_charts": numbers.mapped_charts,
        "faces": len(source.F),
        "mapped_faces": int(result.mapped[source.wedges.polygon].sum()),
        "torn_vertices": int(texcoords.torn.sum()),
        **distortion_fields(distortion),
        "conformal_energy": numbers.conformal_energy,
        "dirichlet_energy": numbers.dirichlet_energy,
        "flipped_polygons": len(numbers.flipped),
        "lost_to_double": numbers.lost_to_double,
        "lost_to_float32": int(numbers.lost_to_float32.sum()),
        "converged_charts": numbers.converged_charts,
        **({} if numbers.coverage is None else {"coverage": numbers.coverage}),
        **_shape_fields(result),
    }


def _shape_fields(result: Unwrapped) -> dict[str, float]:
    """What only maps with a free boundary, or a single rectangle, have."""
    maps = result.charts.shaped
    if maps and isinstance(maps[0], FreeMap):
        return {"crossings": sum(len(found.crossings) for found in maps if isinstance(found, FreeMap))}
    if len(maps) == 1 and isinstance(maps[0], RectangleMap):
        low, high = maps[0].modulus_bounds
        return {"modulus": maps[0].modulus, "modulus_low": low, "modulus_high": high}
    return {}


def distortion_fields(distortion: DistortionNumbers) -> dict[str, float]:
    """What the filters return of the distortion."""
    return {
        "angle_error_mean": distortion.angle_mean,
        "angle_error_rms": distortion.angle_rms,
        "angle_error_sd": distortion.angle_sd,
        "angle_error_max": distortion.angle_max,
        "quasi_conformal_median": distortion.quasi_conformal_median,
        "quasi_conformal_max": distortion.quasi_conformal_max,
    }
