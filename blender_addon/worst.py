"""The faces whose angles a UV map keeps least, whatever made it."""

from __future__ import annotations

import math

import bpy
import numpy as np
from numpy.typing import NDArray

from conformal_uv import polygon_angle_errors

from .face_selection import mapped_mesh


def worst_faces(mesh: bpy.types.Mesh, by: str, share: float, error: float) -> NDArray[np.bool_]:
    """Visible faces of the largest angle errors in the active UV map, (p,); none without a UV map.

    Parameters
    ----------
    by : str
        "SHARE": that many percent of the visible faces, rounded up. "ERROR": all beyond an angle, radians.
    """
    worst = np.zeros(len(mesh.polygons), dtype=bool)
    found = mapped_mesh(mesh)
    if found is None:
        return worst
    arrays, polygons, uv = found
    visible = np.flatnonzero(~arrays.hidden)
    errors = polygon_angle_errors(polygons, uv)[visible]
    if by == "ERROR":
        worst[visible[errors > math.degrees(error)]] = True
        return worst
    count = math.ceil(round(len(visible) * share / 100.0, 6))
    worst[visible[np.argsort(-errors, kind="stable")[:count]]] = True
    return worst
