"""A mesh laid flat by its texture coordinates, torn where they are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..mesh.polygons import PolygonMesh
from .repacked import pack_islands
from .uv_islands import uv_islands

__all__ = ["FlatMesh", "flattened"]


@dataclass(frozen=True, eq=False)
class FlatMesh:
    """The same polygons in the plane.

    Attributes
    ----------
    mesh : PolygonMesh
        A vertex for each vertex of the surface at each of its places in the texture, z = 0.
    vertex : (n,) int64
        The vertex of the surface that each is.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> mesh = cuv.PolygonMesh(np.eye(4, 3), np.array([0, 1, 2, 0, 2, 3]), np.array([0, 3, 6]))
    >>> apart = [[0, 0], [1, 0], [1, 1], [5, 0], [6, 1], [5, 1]]
    >>> flat = cuv.flattened(mesh, apart)
    >>> flat.vertex.tolist(), flat.torn.tolist()
    ([0, 0, 1, 2, 2, 3], [0, 2])
    """

    mesh: PolygonMesh
    vertex: NDArray[np.int64]

    @property
    def torn(self) -> NDArray[np.int64]:
        """Vertices of the surface with several places."""
        return np.flatnonzero(np.bincount(self.vertex) > 1)


def flattened(
    mesh: PolygonMesh, corner_uv: ArrayLike, *, true_size: bool = True, margin: float = 0.0, pack_rotation: str = "none"
) -> FlatMesh:
    """The polygons where their texture coordinates are.

    Parameters
    ----------
    mesh : PolygonMesh
    corner_uv : (k, 2)
        Of every polygon corner.
    true_size : bool
        Every island gets the area of its surface, and they lie side by side; of islands that keep lengths (developable
        surfaces with a free boundary) lengths are true, too. Else positions are the coordinates.
    margin : float
        Between islands that lie side by side, a length.
    pack_rotation
        As in `unwrap`, for these.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> V = np.array([[0.0, 0, 0], [0, 3, 0], [0, 3, 2], [0, 0, 2]])
    >>> uv = [[0, 0], [0.3, 0], [0.3, 0.2], [0, 0.2]]
    >>> flat = cuv.flattened(cuv.PolygonMesh(V, np.arange(4), np.array([0, 4])), uv)
    >>> np.ptp(flat.mesh.V, axis=0).round(9).tolist()
    [3.0, 2.0, 0.0]
    """
    uv = np.nan_to_num(np.asarray(corner_uv, dtype=np.float64), posinf=0.0, neginf=0.0)
    site = uv_islands(mesh, uv).point
    if true_size:
        (uv,) = pack_islands(
            [mesh],
            [uv],
            average_scale=True,
            keep_scale=True,
            margin=0.5 * margin,
            margin_method="add",
            pack_rotation=pack_rotation,
        )
    count = int(site.max(initial=-1)) + 1
    V, vertex = np.zeros((count, 3)), np.zeros(count, dtype=np.int64)
    V[site, :2], vertex[site] = uv, mesh.corners
    return FlatMesh(PolygonMesh(V, site, mesh.starts), vertex)
