"""What a page shows of a map: the arrays, and a few words and numbers about them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..mapped_mesh import MappedMesh
from ..options import Upright
from ..pictures.first_view import first_view
from .packing import PackedArray, packed_integers, packed_reals

__all__ = ["PageModel", "page_model"]

ON_SURFACE, IN_MAP, ERRORS = 2, 3, 2  # bytes of a coordinate or an error
MOST_DOUBLINGS = 32.0  # of the area; what has changed by more, or vanished, counts as this
LEAST_DOUBLINGS = 1.0  # that the colours of areas reach to
SHOWN = 99.0  # percentile of an error that has the last colour


@dataclass(frozen=True, eq=False)
class PageModel:
    """A map as a page holds it.

    Attributes
    ----------
    about : dict
        Title, shape and numbers, as JSON holds them.
    arrays : list of PackedArray
        "surface" (n, 3), "image" (n, 2 or 3), "faces" (m, 3), "angle" (n, 1) in degrees, "area" (n, 1), the binary
        logarithm of how much area grew over its mean.
    """

    about: dict[str, Any]
    arrays: list[PackedArray]


def page_model(mapped: MappedMesh, title: str, upright: Upright = Upright.Z) -> PageModel:
    """The arrays of a mapped mesh, quantised, and what is told of them."""
    angle = mapped.at_vertices(mapped.distortion.angle_error.mean(axis=1))
    area = mapped.at_vertices(_doublings(mapped.distortion.area_scale))
    area -= np.median(area)
    image = mapped.image
    unit = (-1.0, 1.0) if mapped.shape in ("disk", "sphere") else None
    measured = mapped.distortion
    about = {
        "title": title,
        "shape": mapped.shape,
        "view": _view(mapped, upright),
        "vertices": len(np.unique(mapped.vertices)),
        "triangles": len(mapped.F),
        "angle": {"mean": measured.angle_mean, "max": measured.angle_max, "shown": _shown(angle)},
        "area": {"shown": max(_shown(np.abs(area)), LEAST_DOUBLINGS)},
        "flipped": len(measured.flipped),
    }
    arrays = [
        packed_reals("surface", mapped.V, ON_SURFACE),
        packed_reals("image", image, IN_MAP, within=unit),
        packed_integers("faces", mapped.F),
        packed_reals("angle", angle, ERRORS),
        packed_reals("area", area, ERRORS),
    ]
    return PageModel(about, arrays)


def _doublings(area_scale: NDArray[np.float64]) -> NDArray[np.float64]:
    """log2 of the areas' changes over the middle one."""
    good = np.isfinite(area_scale) & (area_scale > 0.0)
    logarithm = np.full(len(area_scale), -MOST_DOUBLINGS)
    logarithm[good] = np.log2(area_scale[good])
    logarithm -= np.median(logarithm[good]) if good.any() else 0.0
    return np.clip(logarithm, -MOST_DOUBLINGS, MOST_DOUBLINGS)


def _shown(errors: NDArray[np.float64]) -> float:
    return max(float(np.percentile(errors, SHOWN)), 1e-3)


def _view(mapped: MappedMesh, upright: Upright) -> list[list[float]]:
    """The surface's first view; see `first_view`."""
    a, b, c = (mapped.V[mapped.F[:, k]] / max(float(np.abs(mapped.V).max()), 1e-300) for k in range(3))
    return first_view(np.cross(b - a, c - a), upright).tolist()
