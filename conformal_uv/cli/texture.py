"""What the texture coordinates of a file are like."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..files import MeshFile
from ..mesh.geometry import triangle_geometry
from ..mesh.triangulate import triangulate
from ..operators import Distortion
from ..operators.distortion import distortion_of

__all__ = ["Texture", "texture_of"]


@dataclass(frozen=True, eq=False)
class Texture:
    """The triangles that have area and coordinates: corners in space (m, 3, 3) and in the texture (m, 3, 2)."""

    corners: NDArray[np.float64]
    image: NDArray[np.float64]
    distortion: Distortion


def texture_of(mesh_file: MeshFile) -> Texture | None:
    """The texture of a file; None where it has none."""
    uv = mesh_file.corner_uv
    if uv is None:
        return None
    _, _, corner_of = triangulate(mesh_file.mesh)
    has = np.isfinite(uv[corner_of]).all(axis=(1, 2))
    corners = corner_of[has].T.astype(np.int32)
    if not corners.size:
        return None
    positions = mesh_file.mesh.V[mesh_file.mesh.corners]
    scaled = positions / max(np.abs(positions).max(), np.finfo(np.float64).tiny)
    good = np.ones(corners.shape[1], dtype=bool)
    good[triangle_geometry(scaled, corners).degenerate] = False
    if not good.any():
        return None
    corners = np.ascontiguousarray(corners[:, good])
    filled = np.nan_to_num(uv, nan=0.0)
    measured = distortion_of(triangle_geometry(scaled, corners), corners, filled)
    return Texture(positions[corners.T], filled[corners.T], measured)
