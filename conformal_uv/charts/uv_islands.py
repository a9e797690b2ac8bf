"""Islands of given texture coordinates: faces that hang together across edges with one place on both sides."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from ..mesh.polygons import PolygonMesh

__all__ = ["uv_islands", "uv_sites"]

Ints = NDArray[np.int64]


def uv_islands(mesh: PolygonMesh, corner_uv: ArrayLike, chosen: NDArray[np.bool_] | None = None) -> Ints:
    """The island of each face, (p,); -1 for faces that are not chosen.

    Parameters
    ----------
    mesh : PolygonMesh
    corner_uv : (k, 2)
        Coordinates of every polygon corner; they are the same where they are the same numbers.
    chosen : (p,) bool, optional
        By default all faces.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> mesh = cuv.PolygonMesh(np.zeros((4, 3)), np.array([0, 1, 2, 0, 2, 3]), np.array([0, 3, 6]))
    >>> uv = np.array([[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]])
    >>> cuv.uv_islands(mesh, uv).tolist(), cuv.uv_islands(mesh, uv + [[0], [0], [0], [1], [1], [1]]).tolist()
    ([0, 0], [0, 1])
    """
    count = len(mesh.sizes)
    face = np.repeat(np.arange(count), mesh.sizes)
    taken = np.ones(count, dtype=bool) if chosen is None else np.asarray(chosen, dtype=bool)
    site = uv_sites(mesh, corner_uv)
    following = np.arange(1, len(face) + 1)
    following[mesh.starts[1:] - 1] = mesh.starts[:-1]
    ends = np.sort(np.stack((site, site[following])), axis=0)
    edge = _numbered(*ends)
    here = taken[face]
    first = np.full(int(edge.max(initial=-1)) + 1, -1)
    first[edge[here][::-1]] = face[here][::-1]
    links = face[here], first[edge[here]]
    _, island = connected_components(coo_matrix((np.ones(len(links[0])), links), shape=(count, count)), directed=False)
    out = np.full(count, -1, dtype=np.int64)
    _, out[taken] = np.unique(island[taken], return_inverse=True)
    return out


def uv_sites(mesh: PolygonMesh, corner_uv: ArrayLike) -> Ints:
    """A number for each corner, (k,), the same for corners of one vertex at one place."""
    uv = np.asarray(corner_uv, dtype=np.float64) + 0.0  # -0 is 0
    return _numbered(mesh.corners, *np.ascontiguousarray(uv.T).view(np.int64))


def _numbered(*keys: NDArray[np.integer]) -> Ints:
    """A number for each row of keys, the same for the same."""
    number = np.unique(keys[0], return_inverse=True)[1]
    for key in keys[1:]:
        other = np.unique(key, return_inverse=True)[1]
        number = np.unique(number * (int(other.max(initial=0)) + 1) + other, return_inverse=True)[1]
    return number.astype(np.int64)
