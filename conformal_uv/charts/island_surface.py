"""One island of a stored UV map as a surface of its own, to be mapped anew."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import OptionError
from ..mesh.polygons import PolygonMesh
from ..mesh.triangulate import triangulate
from .uv_islands import UVIslands

__all__ = ["IslandSurface", "island_surface"]

Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class IslandSurface:
    """Triangles over an island's UV vertices: cut open where the UV map is.

    Attributes
    ----------
    V : (t, 3) float64
        Positions in space of the UV vertices.
    F : (m, 3) int64
        Triangles; wound the other way where the island is mirrored, so that maps of it are mirrored too.
    uv : (t, 2) float64
        Where the UV vertices are now, in units of `scale`.
    scale : (2,) float64
    rim : (t,) bool
        Those on the boundary.
    faces : (f,) int64
        Faces of the mesh.
    corners : (c,) int64
        Their corners.
    point : (c,) int64
        The UV vertex of each of these corners.
    numbers : (t,) int64
        Numbers of the UV vertices in the whole UV map, ascending.
    """

    V: NDArray[np.float64]
    F: Ints
    uv: NDArray[np.float64]
    scale: NDArray[np.float64]
    rim: NDArray[np.bool_]
    faces: Ints
    corners: Ints
    point: Ints
    numbers: Ints

    def farthest(self, point: int) -> int:
        """The boundary's UV vertex farthest from one."""
        rim = np.flatnonzero(self.rim)
        return int(rim[np.argmax(((self.uv[rim] - self.uv[point]) ** 2).sum(axis=1))])


def island_surface(mesh: PolygonMesh, islands: UVIslands, number: int, scale: ArrayLike = (1.0, 1.0)) -> IslandSurface:
    """The surface of one island.

    Parameters
    ----------
    mesh : PolygonMesh
    islands : UVIslands
        Of the same mesh.
    number : int
        Which island.
    scale : (2,) floats
        Units of u and v, where these are not the same length.

    Raises
    ------
    OptionError
        There is no such island.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> mesh = cuv.PolygonMesh(np.eye(4, 3), np.array([0, 1, 2, 3]), np.array([0, 4]))
    >>> islands = cuv.uv_islands(mesh, [[0, 0], [0, 1], [1, 1], [1, 0]])
    >>> cuv.island_surface(mesh, islands, 0).F.shape
    (2, 3)
    """
    if not 0 <= number < islands.count:
        raise OptionError(f"There is no island {number}; the UV map has {islands.count}.")
    faces = np.flatnonzero(islands.island == number)
    corners = np.flatnonzero(np.repeat(islands.island == number, mesh.sizes))
    points, point = np.unique(islands.point[corners], return_inverse=True)
    starts = np.concatenate(([0], np.cumsum(mesh.sizes[faces])))
    part = PolygonMesh(mesh.V[islands.vertex[points]], point.astype(np.int64), starts)
    F, _, _ = triangulate(part)
    unit = np.asarray(scale, dtype=np.float64)
    uv = islands.uv[points] / unit
    first, second, third = uv[F].transpose(1, 2, 0)
    area = np.sum((second - first)[0] * (third - first)[1] - (second - first)[1] * (third - first)[0])
    return IslandSurface(
        V=part.V,
        F=np.ascontiguousarray(F[:, ::-1]) if area < 0.0 else F,
        uv=uv,
        scale=unit,
        rim=islands.rim[points],
        faces=faces,
        corners=corners,
        point=part.corners,
        numbers=points,
    )
