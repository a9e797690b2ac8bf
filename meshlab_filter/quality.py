"""The distortion of every polygon, and the numbers of a whole map."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from conformal_uv import Unwrapped
from conformal_uv.options import Choice

from .current_mesh import CurrentMesh
from .texcoords import Texcoords

__all__ = ["Quality", "map_numbers", "polygon_quality"]



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
    total, count = np.zeros(len(result.mapped)), np.zeros(len(result.mapped))
    for chart in result.charts:
        if chart.distortion is None:
            continue
        d = chart.distortion
        value = d.angle_error.mean(axis=1) if quality is Quality.ANGLE else _bounded(d.quasi_conformal)
        np.add.at(total, chart.polygon, value)
        np.add.at(count, chart.polygon, 1.0)
    return total / np.maximum(count, 1.0)


def _bounded(ratio: NDArray[np.float64]) -> NDArray[np.float64]:
    finite = ratio[np.isfinite(ratio)]
    return np.minimum(ratio, finite.max() if len(finite) else 1.0)


def map_numbers(source: CurrentMesh, result: Unwrapped, texcoords: Texcoords) -> dict[str, float]:
    """What the filter returns."""
    maps = [chart.map for chart in result.charts if chart.map is not None]
    done = [chart.distortion for chart in result.charts if chart.distortion is not None]
    error = np.concatenate([d.angle_error.reshape(-1) for d in done])
    ratio = np.concatenate([d.quasi_conformal for d in done])
    new = result.mapped[source.wedges.polygon]
    return {
        "charts": len(result.charts),
        "mapped_charts": len(maps),
        "faces": len(source.F),
        "mapped_faces": int(new.sum()),
        "torn_vertices": int(texcoords.torn.sum()),
        "angle_error_mean": float(error.mean()),
        "angle_error_sd": float(error.std()),
        "angle_error_max": float(error.max()),
        "quasi_conformal_median": float(np.median(ratio)),
        "quasi_conformal_max": float(ratio.max()),
        "conformal_energy": sum(m.conformal_energy for m in maps),
        "dirichlet_energy": sum(m.dirichlet_energy for m in maps),
        "flipped_polygons": sum(len(chart.flipped) for chart in result.charts),
        "lost_to_double": sum(len(m.lost_to_double) for m in maps),
        "lost_to_float32": int(result.lost_to_float32().sum()),
        "converged_charts": sum(m.converged for m in maps),
    }
