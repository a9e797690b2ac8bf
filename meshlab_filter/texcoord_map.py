"""Texture coordinates of the current mesh by conformal maps: what the filters and the script share."""

from __future__ import annotations

import logging
from dataclasses import dataclass
from os import PathLike
from typing import Any

import numpy as np

from conformal_uv import FreeMap, OptionError, Unwrapped, unwrap
from conformal_uv.options import Shape

from .current_mesh import read_current_mesh
from .exceptions import pymeshlab_errors
from .function_filters import check_function_filters
from .quality import Quality, map_numbers, polygon_quality
from .script_history import unrecorded
from .texcoords import check_texture, new_texcoords, write_face_scalar, write_texcoords

__all__ = ["Mapped", "map_current_mesh"]

logger = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class Mapped:
    """What was done: the map of the polygons, and the numbers the filter returns."""

    result: Unwrapped
    numbers: dict[str, float]


def map_current_mesh(
    shape: Shape,
    ms: Any,
    *,
    selected_only: bool = False,
    texture: str | PathLike[str] | None = None,
    quality: str = "none",
    **options: Any,
) -> Mapped:
    """The filter of a shape, with all that is known of the map.

    `options` are those of `conformal_uv.unwrap`. Other names and values are refused before anything is written.
    """
    with pymeshlab_errors(f"compute_texcoord_parametrization_conformal_{shape}"):
        scalar = Quality.of("quality", quality)
        if not isinstance(selected_only, bool | np.bool_):
            raise OptionError(f"selected_only is {selected_only!r}; pass True or False.")
        if texture is not None:
            check_texture(texture)
        source = read_current_mesh(ms)
        with unrecorded(ms):
            check_function_filters(ms)
        selection = source.selected_polygons() if selected_only else None
        result = unwrap(None, source.polygons, selection=selection, shape=shape, **options)
        _check_mapped(result)
        texcoords = new_texcoords(source, result.uv, result.mapped)
        numbers = map_numbers(source, result, texcoords)
        with unrecorded(ms):
            write_texcoords(ms, source.mesh, texcoords, texture)
            if scalar is not Quality.NONE:
                polygon = source.wedges.polygon
                values = polygon_quality(result, scalar)[polygon]
                write_face_scalar(ms, source.mesh, values, result.mapped[polygon])
    return Mapped(result, numbers)


def _check_mapped(result: Unwrapped) -> None:
    """Raise where no chart was mapped; log the reasons where some were not, and boundaries that cross themselves."""
    failure = result.failure()
    if failure is not None:
        raise failure
    if result.charts.errors:
        logger.warning("%s", result.summary)
    crossing = sum(isinstance(found, FreeMap) and len(found.crossings) > 0 for found in result.charts.shaped)
    if crossing:
        logger.warning("The boundary of %d charts crosses itself; parts of the surface share their texture.", crossing)
