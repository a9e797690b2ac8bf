"""The filter: texture coordinates of the current mesh by conformal maps onto rectangles."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike
from typing import Any

from numpy.typing import ArrayLike

from conformal_uv import Callback
from conformal_uv.options import Shape

from .texcoord_map import map_current_mesh

__all__ = ["compute_texcoord_parametrization_conformal_rectangle"]


def compute_texcoord_parametrization_conformal_rectangle(
    ms: Any,
    *,
    corners: Iterable[Any] | None = None,
    corner_choice: str = "turning",
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
    """Parametrize the current mesh by conformal maps onto rectangles, in place.

    Every connected part with the topology of a disk goes onto a rectangle, its longest boundary exactly onto the sides,
    with angles kept as well as the triangles allow. It is written as by
    `compute_texcoord_parametrization_conformal_disk`.

    Parameters
    ----------
    ms : pymeshlab.MeshSet
    corners : four Integers
        Boundary vertices that become the corners, in the direction of the boundary, the first at the lower left;
        several fours for several parts. Parts with none choose their own; parts with corners are not turned upright.
    corner_choice : Enum
        Where none are given: 'turning' (default: where the boundary turns most) or 'area' (the least change of area).
    place : Enum
        'fit' and 'pack': in the unit square, which a single part fills one way; 'disk': each part so in the middle of
        [-1, 1]^2, one over the other.
    upright, holes, closed, nonmanifold, orientation, repair, laplacian, seams, selected_only, backend, texture, quality
        As in `compute_texcoord_parametrization_conformal_disk`, and `margin`,
        `margin_method`, `image_size`, `pack_rotation`, `pack_shape`, `keep_scale`, `tile` and `callback` too.

    Returns
    -------
    dict of numbers
        Those of `compute_texcoord_parametrization_conformal_disk`, and of a single part modulus (the rectangle's
        width for its height before it is turned), modulus_low and modulus_high (certain to enclose it).

    Raises
    ------
    pymeshlab.PyMeshLabException
        The MeshSet has no current mesh.
    ConformalFilterException
        A PyMeshLabException: an option is not taken, or no part could be mapped; ``__cause__`` tells the kind.
    """
    return map_current_mesh(
        Shape.RECTANGLE,
        ms=ms,
        pins=corners,
        corner_choice=corner_choice,
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
