"""The filter: texture coordinates of the current mesh by conformal maps onto disks."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from dataclasses import dataclass
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from conformal_uv import Callback, OptionError, Unwrapped, unwrap

from .current_mesh import read_current_mesh
from .exceptions import pymeshlab_errors
from .function_filters import check_function_filters
from .quality import Quality, map_numbers, polygon_quality
from .script_history import unrecorded
from .texcoords import check_texture, new_texcoords, write_face_scalar, write_texcoords

__all__ = ["Mapped", "compute_texcoord_parametrization_conformal_disk", "map_current_mesh"]

NAME = "compute_texcoord_parametrization_conformal_disk"

logger = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class Mapped:
    """What was done: the map of the polygons, and the numbers the filter returns."""

    result: Unwrapped
    numbers: dict[str, float]


def compute_texcoord_parametrization_conformal_disk(
    ms: Any,
    *,
    method: str = "auto",
    objective: str | None = None,
    holes: str = "fill",
    closed: str = "refuse",
    nonmanifold: str = "refuse",
    orientation: str = "refuse",
    repair: str = "auto",
    laplacian: str = "auto",
    center: int | Iterable[int] | None = None,
    boundary_vertex: int | Iterable[int] | None = None,
    pins: Iterable[Any] | None = None,
    pin_mode: str | None = None,
    seams: ArrayLike | None = None,
    selected_only: bool = False,
    place: str = "fit",
    margin: float | None = None,
    backend: str = "auto",
    texture: str | PathLike[str] | None = None,
    quality: str = "none",
    callback: Callback | None = None,
) -> dict[str, float]:
    """Parametrize the current mesh by conformal maps onto disks, in place.

    Every connected part with the topology of a disk goes onto a disk, its longest boundary onto the circle, with
    angles kept as well as the triangles allow. Wedge texture coordinates are written for all mapped faces, vertex
    texture coordinates for their vertices (where charts meet, of the first of them). Nothing else of the mesh
    changes. After an exception the MeshSet is as it was.

    Parameters
    ----------
    ms : pymeshlab.MeshSet
    method : Enum
        'auto' (default: the better of the next two), 'linear', 'newton', 'augmented-lagrangian'.
    objective : Enum
        'conformal' or 'dirichlet'; the default is the method's own.
    holes : Enum
        Boundary loops but the longest: 'fill' (for the solution only) or 'refuse'.
    closed : Enum
        Closed parts and parts with handles: 'refuse' or 'cut' open.
    nonmanifold : Enum
        Edges of three or more faces, parts that touch in a vertex: 'refuse' or 'cut'.
    orientation : Enum
        Faces wound against their neighbours: 'refuse' or 'mend' (for the solution only).
    repair : Enum
        Folded triangles: 'auto' unfolds them, 'never' leaves them.
    laplacian : Enum
        'auto', 'cotan', 'intrinsic-delaunay'.
    center, boundary_vertex : Integer
        Vertex sent to the center, boundary vertex sent to angle 0; several for several parts.
    pins : three Integers
        Boundary vertices sent to the cube roots of unity; several triples for several parts.
    pin_mode : Enum
        'moebius' (default) or 'constraint'.
    seams : (s, 2) Integers
        Edges to cut along, as vertex pairs.
    selected_only : Boolean
        Map only selected faces (of a polygon, all its triangles); the others keep their coordinates.
    place : Enum
        'fit' and 'pack': in the unit square; 'disk': on the unit disk around (0, 0).
    margin : Float
        Least distance between disks and to the sides of the square; by default none for one disk, 0.005 for several.
    backend : Enum
        'auto', 'cholmod', 'superlu', 'multigrid'.
    texture : File Name
        Image to link, for all faces.
    quality : Enum
        Per-face scalar to write: 'none', 'angle' (mean angle error, degrees), 'quasi-conformal' (ratio of the
        singular values).
    callback : callable
        Called as ``callback(stage, fraction)``; returning False stops the filter.

    Returns
    -------
    dict of numbers
        charts, mapped_charts, faces, mapped_faces, torn_vertices, angle_error_mean, angle_error_rms, angle_error_sd,
        angle_error_max (degrees), quasi_conformal_median, quasi_conformal_max, conformal_energy, dirichlet_energy,
        flipped_polygons, lost_to_double, lost_to_float32 (faces without area as stored), converged_charts.

    Raises
    ------
    pymeshlab.PyMeshLabException
        The MeshSet has no current mesh.
    ConformalFilterException
        A PyMeshLabException: an option is not taken, or no part could be mapped; ``__cause__`` tells the kind.
    """
    mapped = map_current_mesh(
        ms,
        method=method,
        objective=objective,
        holes=holes,
        closed=closed,
        nonmanifold=nonmanifold,
        orientation=orientation,
        repair=repair,
        laplacian=laplacian,
        center=center,
        boundary_vertex=boundary_vertex,
        pins=pins,
        pin_mode=pin_mode,
        seams=seams,
        selected_only=selected_only,
        place=place,
        margin=margin,
        backend=backend,
        texture=texture,
        quality=quality,
        callback=callback,
    )
    return mapped.numbers


def map_current_mesh(
    ms: Any,
    *,
    selected_only: bool = False,
    texture: str | PathLike[str] | None = None,
    quality: str = "none",
    **options: Any,
) -> Mapped:
    """The filter with all that is known of the map; `options` as `conformal_uv.unwrap` takes them."""
    with pymeshlab_errors(NAME):
        scalar = Quality.of("quality", quality)
        if not isinstance(selected_only, bool | np.bool_):
            raise OptionError(f"selected_only is {selected_only!r}; pass True or False.")
        if texture is not None:
            check_texture(texture)
        source = read_current_mesh(ms)
        with unrecorded(ms):
            check_function_filters(ms)
        selection = source.selected_polygons() if selected_only else None
        result = unwrap(None, source.polygons, selection=selection, **options)
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
    """Raise where no chart was mapped; log the reasons where some were not."""
    failure = result.failure()
    if failure is not None:
        raise failure
    if any(chart.error is not None for chart in result.charts):
        logger.warning("%s", result.summary)
