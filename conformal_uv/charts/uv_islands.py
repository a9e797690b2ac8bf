"""The islands of a UV map as it is stored, a UV for every corner: what hangs together across sides with equal UVs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from ..errors import OptionError
from ..mesh.halfedges import joined_pairs, paired_sides
from ..mesh.polygon_sides import following_corners
from ..mesh.polygons import PolygonMesh

__all__ = ["UVIslands", "uv_islands"]

Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class UVIslands:
    """A UV map welded: corners of one vertex with one UV are one UV vertex.

    Attributes
    ----------
    point : (k,) int64
        The UV vertex of each corner.
    vertex : (t,) int64
        The mesh's vertex of each UV vertex.
    uv : (t, 2) float64
        Position of each UV vertex.
    island : (p,) int64
        The island of each face, numbered from 0; -1 for faces that were not asked for.
    rim : (t,) bool
        UV vertices on the boundary of their island.
    sides : (s, 2) int64
        Sides of the islands' faces, from UV vertex to UV vertex.
    rim_sides : (b, 2) int64
        Those on the boundary.
    """

    point: Ints
    vertex: Ints
    uv: NDArray[np.float64]
    island: Ints
    rim: NDArray[np.bool_]
    sides: Ints
    rim_sides: Ints

    @property
    def count(self) -> int:
        """Number of islands."""
        return int(self.island.max(initial=-1)) + 1

    def island_of_points(self, mesh: PolygonMesh) -> Ints:
        """The island of each UV vertex, (t,); -1 where it is in none."""
        out = np.full(len(self.vertex), -1, dtype=np.int64)
        out[self.point] = np.repeat(self.island, mesh.sizes)
        return out


def uv_islands(mesh: PolygonMesh, corner_uv: ArrayLike, faces: ArrayLike | None = None) -> UVIslands:
    """Find the islands of a UV map.

    Parameters
    ----------
    mesh : PolygonMesh
    corner_uv : (k, 2) floats
        Stored UVs; they are equal or they are not, without a tolerance.
    faces : (p,) bool, optional
        Faces that count; by default all.

    Raises
    ------
    OptionError
        Arrays that do not fit the mesh.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> mesh = cuv.PolygonMesh(np.eye(4, 3), np.array([0, 1, 2, 0, 2, 3]), np.array([0, 3, 6]))
    >>> cuv.uv_islands(mesh, [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]]).island.tolist()
    [0, 0]
    """
    uv = np.asarray(corner_uv)
    k, p = len(mesh.corners), len(mesh.starts) - 1
    if uv.shape != (k, 2):
        raise OptionError(f"corner_uv has the shape {uv.shape}; the mesh has {k} corners: pass ({k}, 2).")
    chosen = np.ones(p, dtype=bool) if faces is None else np.asarray(faces, dtype=bool)
    if chosen.shape != (p,):
        raise OptionError(f"faces has the shape {chosen.shape}; the mesh has {p} faces: pass ({p},).")
    point, first = _welded(mesh.corners, uv)
    t = len(first)
    island = np.full(p, -1, dtype=np.int64)
    used = np.repeat(chosen, mesh.sizes)
    corners = np.flatnonzero(used)
    sides = np.column_stack((point[corners], point[following_corners(mesh)[corners]]))
    rim, rim_sides = np.zeros(t, dtype=bool), np.empty((0, 2), dtype=np.int64)
    if len(corners):
        twin = paired_sides(sides[:, 0], sides[:, 1].copy(), t).twin
        one, other = joined_pairs(twin)
        number = np.cumsum(chosen) - 1
        face = number[np.repeat(np.arange(p), mesh.sizes)[corners]]
        count = int(chosen.sum())
        joined = csr_array((np.ones(len(one), dtype=bool), (face[one], face[other])), shape=(count, count))
        island[chosen] = connected_components(joined, directed=False)[1]
        rim_sides = sides[twin < 0]
        rim[rim_sides] = True
    return UVIslands(
        point=point,
        vertex=mesh.corners[first].astype(np.int64),
        uv=uv[first].astype(np.float64),
        island=island,
        rim=rim,
        sides=sides,
        rim_sides=rim_sides,
    )


def _welded(corners: NDArray[np.integer], uv: NDArray[np.floating]) -> tuple[Ints, Ints]:
    """For every corner the number of its UV vertex, and a corner of each UV vertex."""
    order = np.lexsort((uv[:, 1], uv[:, 0], corners))
    if not len(order):
        return order, order
    vertex, place = corners[order], uv[order]
    new = np.empty(len(order), dtype=bool)
    new[0] = True
    new[1:] = (vertex[1:] != vertex[:-1]) | (place[1:] != place[:-1]).any(axis=1)
    point = np.empty(len(order), dtype=np.int64)
    point[order] = np.cumsum(new) - 1
    return point, order[new]
