"""The filter: texture coordinates of the current mesh by conformal maps with a free boundary."""

from __future__ import annotations

from os import PathLike
from typing import Any

from numpy.typing import ArrayLike

from conformal_uv import Callback
from conformal_uv.options import Shape

from .texcoord_map import map_current_mesh

__all__ = ["compute_texcoord_parametrization_conformal_free"]


def compute_texcoord_parametrization_conformal_free(
    ms: Any,
    *,
    refine: bool = False,
    upright: str = "z",
    holes: str = "fill",
    closed: str = "refuse",
    nonmanifold: str = "refuse",
    orientation: str = "refuse",
    repair: str = "auto",
    laplacian: str = "auto",
    seams: ArrayLike | None = None,
    selected_only: bool = False,
    place: str = "fit",
    margin: float | None = None,
    margin_method: str = "between",
    image_size: int = 1024,
    pack_rotation: str = "none",
    pack_shape: str = "outline",
    keep_scale: bool = False,
    tile: int = 1001,
    backend: str = "auto",
    texture: str | PathLike[str] | None = None,
    quality: str = "none",
    callback: Callback | None = None,
) -> dict[str, float]:
    """Parametrize the current mesh by laying it into the plane with a free boundary, in place.

    Every connected part with the topology of a disk gets an outline of its own, along which lengths are kept as far as
    the boundary can close; angles are kept as well as the triangles allow. What can be unrolled comes out unrolled, but
    for one scale. It is written as by `compute_texcoord_parametrization_conformal_disk`.

    Parameters
    ----------
    ms : pymeshlab.MeshSet
    refine : Boolean
        Move all vertices to a smaller angle error, where there is one; takes several times as long.
    place : Enum
        'fit' and 'pack': in the unit square, which a single part fills one way; 'disk': each part so in the middle of
        [-1, 1]^2, one over the other.
    upright, holes, closed, nonmanifold, orientation, repair, laplacian, seams, selected_only, backend, texture, quality
        As in `compute_texcoord_parametrization_conformal_disk`, and `margin`,
        `margin_method`, `image_size`, `pack_rotation`, `pack_shape`, `keep_scale`, `tile` and `callback` too.

    Returns
    -------
    dict of numbers
        Those of `compute_texcoord_parametrization_conformal_disk`, and crossings: how often boundaries cross
        themselves, where parts share their texture.

    Raises
    ------
    pymeshlab.PyMeshLabException
        The MeshSet has no current mesh.
    ConformalFilterException
        A PyMeshLabException: an option is not taken, or no part could be mapped; ``__cause__`` tells the kind.
    """
    return map_current_mesh(
        Shape.FREE,
        ms=ms,
        refine=refine,
        upright=upright,
        holes=holes,
        closed=closed,
        nonmanifold=nonmanifold,
        orientation=orientation,
        repair=repair,
        laplacian=laplacian,
        seams=seams,
        selected_only=selected_only,
        place=place,
        margin=margin,
        margin_method=margin_method,
        image_size=image_size,
        pack_rotation=pack_rotation,
        pack_shape=pack_shape,
        keep_scale=keep_scale,
        tile=tile,
        backend=backend,
        texture=texture,
        quality=quality,
        callback=callback,
    ).numbers
