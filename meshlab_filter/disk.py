"""The filter: texture coordinates of the current mesh by conformal maps onto disks."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike
from typing import Any

from numpy.typing import ArrayLike

from conformal_uv import Callback
from conformal_uv.options import Shape

from .texcoord_map import map_current_mesh

__all__ = ["compute_texcoord_parametrization_conformal_disk"]


def compute_texcoord_parametrization_conformal_disk(
    ms: Any,
    *,
    method: str = "auto",
    objective: str | None = None,
    upright: str = "z",
    holes: str = "fill",
    closed: str = "refuse",
    nonmanifold: str = "refuse",
    orientation: str = "refuse",
    repair: str = "auto",
    laplacian: str = "auto",
    center: int | Iterable[int] | None = None,
    boundary_vertex: int | Iterable[int] | None = None,
    balance: str = "middle",
    pins: Iterable[Any] | None = None,
    pin_mode: str | None = None,
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
    upright : Enum
        Axis of the surface that points up in the texture: 'z' (default), 'y' or 'none'. Parts that lie flat have the
        next axis up; parts with pins or a boundary vertex are not turned.
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
    balance : Enum
        What is in the middle without a center and pins: 'middle' (default, of the surface) or 'area' (what the Moebius
        map of least area distortion puts there).
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
        'fit' and 'pack': in the unit square; 'disk': on the unit disk around (0, 0), one part over the other.
    margin : Float
        Least distance between parts and to the sides of the square; by default none about one, 0.005 for several.
    margin_method : Enum
        What the margin is: 'between' parts, as a part of the square's side (default); around each part as in Blender
        'fraction', 'add' or 'scaled'; or 'pixels' of a square image.
    image_size : Integer
        That image's side, pixels.
    pack_rotation : Enum
        How parts may be turned to fill the square better: 'none' (default), 'quarters', 'axes', 'any'.
    pack_shape : Enum
        What is packed: the 'outline' (default), its 'convex' hull or its 'box'.
    keep_scale : Boolean
        Parts keep the size of the surface, and may lie beyond the square.
    tile : Integer
        UDIM tile to pack into.
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
        flipped_polygons, lost_to_double, lost_to_float32 (faces without area as stored), converged_charts,
        and where parts are placed in the unit square coverage (the share of it that they fill).

    Raises
    ------
    pymeshlab.PyMeshLabException
        The MeshSet has no current mesh.
    ConformalFilterException
        A PyMeshLabException: an option is not taken, or no part could be mapped; ``__cause__`` tells the kind.
    """
    return map_current_mesh(
        Shape.DISK,
        ms=ms,
        method=method,
        objective=objective,
        upright=upright,
        holes=holes,
        closed=closed,
        nonmanifold=nonmanifold,
        orientation=orientation,
        repair=repair,
        laplacian=laplacian,
        center=center,
        boundary_vertex=boundary_vertex,
        balance=balance,
        pins=pins,
        pin_mode=pin_mode,
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
