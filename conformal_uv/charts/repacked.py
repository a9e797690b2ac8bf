"""Islands that there are, whatever made them, packed anew."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..mesh.polygons import PolygonMesh
from ..mesh.triangulate import triangulate
from ..options import PlaceOptions
from .outlines import joint_outlines
from .packing import pack_charts
from .uv_islands import uv_islands

__all__ = ["pack_islands"]

Real = NDArray[np.float64]


def pack_islands(
    meshes: Sequence[PolygonMesh],
    corner_uvs: Sequence[ArrayLike],
    chosen: Sequence[NDArray[np.bool_]] | None = None,
    *,
    average_scale: bool = False,
    margin: float | None = None,
    **options: Any,
) -> list[Real]:
    """Texture coordinates of several meshes with all their islands packed into one square.

    Parameters
    ----------
    meshes : sequence of PolygonMesh
    corner_uvs : sequence of (k, 2)
        Of every polygon corner of each mesh.
    chosen : sequence of (p,) bool, optional
        Faces whose islands are packed; coordinates of others stay as they are.
    average_scale : bool
        Areas of islands come to be to those of the surfaces as one number to all; else islands keep their sizes to each
        other.
    margin, margin_method, image_size, pack_rotation, pack_shape, keep_scale, tile
        As in `unwrap`.

    Returns
    -------
    list of (k, 2) float64

    Raises
    ------
    OptionError

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> mesh = cuv.PolygonMesh(np.eye(6, 3), np.arange(6), np.array([0, 3, 6]))
    >>> uv = np.array([[0, 0], [1, 0], [0, 1], [1, 1], [0, 1], [1, 0]], dtype=float)
    >>> (packed,) = cuv.pack_islands([mesh], [uv], margin=0.01)
    >>> bool(packed.min() >= 0.01), bool(packed.max() <= 0.99)
    (True, True)
    """
    where = PlaceOptions(margin=margin, **options)
    mesh = _joined(meshes)
    uv = np.concatenate([np.asarray(one, dtype=np.float64).reshape(-1, 2) for one in corner_uvs])
    island = uv_islands(mesh, uv, None if chosen is None else np.concatenate(chosen)).island
    finite = np.nan_to_num(uv, posinf=0.0, neginf=0.0)
    flat = PolygonMesh(np.column_stack((finite, np.zeros(len(uv)))), np.arange(len(uv)), mesh.starts)
    triangles, face, _ = triangulate(flat)
    packed = island[face] >= 0
    triangles, owner = triangles[packed], island[face][packed]
    z = np.ascontiguousarray(flat.V[:, :2]).view(np.complex128).reshape(-1)
    if average_scale:
        z = z * _scales(mesh, flat, triangles, owner)[island[np.repeat(np.arange(len(mesh.sizes)), mesh.sizes)]]
    corner = np.flatnonzero(np.repeat(island, mesh.sizes) >= 0)
    moved = pack_charts(joint_outlines(z, triangles.T, owner) if len(owner) else [], where).placed(
        z[corner], np.repeat(island, mesh.sizes)[corner]
    )
    uv[corner] = np.ascontiguousarray(moved).view(np.float64).reshape(-1, 2)
    return np.split(uv, np.cumsum([len(one.corners) for one in meshes])[:-1])


def _joined(meshes: Sequence[PolygonMesh]) -> PolygonMesh:
    """All meshes as one."""
    vertices, corners = np.cumsum([[0, 0]] + [[len(mesh.V), len(mesh.corners)] for mesh in meshes], axis=0).T
    starts = [mesh.starts[:-1] + first for mesh, first in zip(meshes, corners, strict=False)]
    return PolygonMesh(
        np.concatenate([mesh.V for mesh in meshes]),
        np.concatenate([mesh.corners + first for mesh, first in zip(meshes, vertices, strict=False)]),
        np.concatenate([*starts, corners[-1:]]),
    )


def _scales(mesh: PolygonMesh, flat: PolygonMesh, triangles: NDArray[np.int64], owner: NDArray[np.int64]) -> Real:
    """Factors of the islands, one more for corners of none, that bring areas to those of the surface."""
    surface, image = (np.bincount(owner, _areas(V[triangles])) for V in (np.nan_to_num(mesh.V[mesh.corners]), flat.V))
    scale = np.sqrt(np.divide(surface, image, out=np.ones(len(image)), where=(image > 0.0) & (surface > 0.0)))
    return np.append(scale, 1.0)


def _areas(P: Real) -> Real:
    """Of triangles (m, 3, 3)."""
    return 0.5 * np.linalg.norm(np.cross(P[:, 1] - P[:, 0], P[:, 2] - P[:, 0]), axis=1)
