"""A result in polyscope: the surface and its map side by side, with checker and errors."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..mapped_mesh import AnyMap, MappedMesh, mapped_mesh
from ..options import Upright
from ..pictures.first_view import first_view
from .libraries import library

__all__ = ["INSTALL", "polyscope_scene", "to_polyscope"]

Real = NDArray[np.float64]

INSTALL = '"conformal-uv[view]"'
SQUARES = 16  # of the checker, across the map
GAP = 0.15  # between surface and map, of the surface's size
SHOWN = 99.0  # percentile of an error that has the last colour


def to_polyscope(result: AnyMap, name: str = "surface") -> tuple[Any, Any]:
    """See `Shown.to_polyscope`."""
    polyscope = library("polyscope", "to_polyscope()", INSTALL)
    if not polyscope.is_initialized():
        polyscope.init()
    return polyscope_scene(polyscope, mapped_mesh(result), name, Upright.Z)


def polyscope_scene(polyscope: Any, mapped: MappedMesh, name: str, upright: Upright) -> tuple[Any, Any]:
    """Register the surface as `name` and its map beside it, and look at both from the front."""
    axes = _axes(mapped, upright)
    middle, size = _box(mapped.V)
    beside = _beside(mapped, axes, middle, size)
    surface = polyscope.register_surface_mesh(name, mapped.V, mapped.F, smooth_shade=len(mapped.F) > 4000)
    flat = polyscope.register_surface_mesh(f"{name}, map", beside, mapped.F, smooth_shade=mapped.shape == "sphere")
    for structure in (surface, flat):
        _add_quantities(structure, mapped)
    polyscope.set_ground_plane_mode("none")
    both, whole = _box(np.concatenate((mapped.V @ axes.T, beside @ axes.T)))
    target = both @ axes
    polyscope.set_up_dir(_named(axes[1]))
    polyscope.look_at_dir(target + whole * axes[2], target, axes[1])
    return surface, flat


def _add_quantities(structure: Any, mapped: MappedMesh) -> None:
    measured = mapped.distortion
    angle = measured.angle_error.mean(axis=1)
    area = measured.area_scale
    good = np.isfinite(area) & (area > 0.0)
    doublings = np.zeros(len(area))
    doublings[good] = np.log2(area[good]) - np.median(np.log2(area[good]))
    limits = [max(float(np.percentile(values, SHOWN)), 1e-6) for values in (angle, np.abs(doublings))]
    for name, values, colours, range_shown in (
        ("angle error, degrees", angle, "viridis", (0.0, limits[0])),
        ("area, doublings over the middle", doublings, "coolwarm", (-limits[1], limits[1])),
    ):
        structure.add_scalar_quantity(name, values, defined_on="faces", cmap=colours, vminmax=range_shown)
    if mapped.image.shape[1] == 3:
        places = 0.5 + 0.45 * mapped.image
        structure.add_color_quantity("place on the sphere", places, defined_on="vertices", enabled=True)
        return
    width = max(float(np.ptp(mapped.image, axis=0).max()), 1e-300)
    structure.add_parameterization_quantity(
        "checker",
        mapped.image / width,
        defined_on="vertices",
        coords_type="unit",
        viz_style="checker",
        checker_size=1.0 / SQUARES,
        checker_colors=((0.965, 0.953, 0.918), (0.24, 0.435, 0.647)),
        enabled=True,
    )


def _axes(mapped: MappedMesh, upright: Upright) -> Real:
    """What is to the right, up and in front of the surface, as rows."""
    size = max(float(np.abs(mapped.V).max()), 1e-300)
    a, b, c = (mapped.V[mapped.F[:, k]] / size for k in range(3))
    return first_view(np.cross(b - a, c - a), upright)


def _beside(mapped: MappedMesh, axes: Real, middle: Real, size: float) -> Real:
    """The map as large as the surface, to its right, facing the same way."""
    low, high = mapped.image.min(axis=0), mapped.image.max(axis=0)
    own = (mapped.image - 0.5 * (low + high)) * (size / max(float((high - low).max()), 1e-300))
    turned = own if own.shape[1] == 3 else own @ axes[:2]
    wide = float(np.ptp(mapped.V @ axes[0]) + np.ptp(turned @ axes[0]))
    return middle + turned + (0.5 * wide + GAP * size) * axes[0]


def _box(V: Real) -> tuple[Real, float]:
    low, high = V.min(axis=0), V.max(axis=0)
    return 0.5 * (low + high), float((high - low).max())


def _named(up: Real) -> str:
    """The axis nearest to a direction, as polyscope names it."""
    axis = int(np.argmax(np.abs(up)))
    return f"{'neg_' if up[axis] < 0 else ''}{'xyz'[axis]}_up"
