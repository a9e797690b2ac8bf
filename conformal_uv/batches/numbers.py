"""The numbers of a map as fields of a row; what they mean says `report`."""

from __future__ import annotations

from dataclasses import asdict
from math import isfinite
from typing import Any

from ..charts import Unwrapped
from ..free import FreeMap
from ..rectangle import RectangleMap
from ..report import DistortionNumbers, distortion_numbers, unwrap_numbers
from ..sphere import SphereMap

__all__ = ["sphere_fields", "unwrapped_fields"]


def unwrapped_fields(result: Unwrapped) -> dict[str, Any]:
    """Of an unwrapped mesh, over all its charts; those of the map where there is one chart."""
    numbers = unwrap_numbers(result)
    told: dict[str, Any] = {
        name: getattr(numbers, name)
        for name in ("vertices", "triangles", "charts", "mapped_charts", "converged_charts", "conformal_energy")
    }
    told |= {
        "dirichlet_energy": numbers.dirichlet_energy,
        "flipped": len(numbers.flipped),
        "lost_to_double": numbers.lost_to_double,
        "lost_to_float32": int(numbers.lost_to_float32.sum()),
        "coverage": numbers.coverage,
    }
    if numbers.distortion is not None:
        told |= _distortion_fields(numbers.distortion)
    only = result.charts[0].map if numbers.charts == 1 else None
    if only is not None:
        told |= {"laplacian": only.laplacian, "backend": only.backend, "boundary_vertices": len(only.boundary)}
    if isinstance(only, RectangleMap):
        low, high = only.modulus_bounds
        told |= {"modulus": only.modulus, "modulus_low": low, "modulus_high": high}
    elif isinstance(only, FreeMap):
        told["crossings"] = len(only.crossings)
    elif only is not None:
        told["method"] = str(only.method)
    return _finite(told)


def sphere_fields(result: SphereMap) -> dict[str, Any]:
    """Of a map to the sphere."""
    return _finite(
        {
            "vertices": result.surface.n,
            "triangles": result.surface.m,
            "method": str(result.method),
            "laplacian": result.laplacian,
            "charts": 1,
            "mapped_charts": 1,
            "converged_charts": int(result.converged),
            "conformal_energy": result.conformal_energy,
            "dirichlet_energy": result.dirichlet_energy,
            "flipped": len(result.flipped),
            "signed_volume": result.signed_volume,
            **_distortion_fields(distortion_numbers([result.distortion])),
        }
    )


def _distortion_fields(numbers: DistortionNumbers) -> dict[str, Any]:
    return asdict(numbers)


def _finite(told: dict[str, Any]) -> dict[str, Any]:
    """None for what is infinite, which JSON has no word for."""
    return {name: None if isinstance(value, float) and not isfinite(value) else value for name, value in told.items()}
