"""Islands of a stored UV map that are maps onto a disk, and Moebius maps of them.

A disk map stays one, as conformal as it was, under the conformal maps of the disk onto itself: they choose what comes
to the middle, and how it is turned.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from ..mesh.polygon_sides import following_corners
from ..mesh.polygons import PolygonMesh
from ..operators.moebius import Moebius
from ..operators.round_place import RoundPlace, fitted_place
from .uv_islands import UVIslands, uv_islands

__all__ = ["DiskIsland", "disk_islands"]

Ints = NDArray[np.int64]
TOLERANCE = 1e-4  # of the radius, between the boundary and its circle: single precision, and a digit or two lost since


@dataclass(frozen=True, eq=False)
class DiskIsland:
    """An island whose boundary lies on a circle, or on an axis-parallel ellipse that was one on another image.

    Attributes
    ----------
    number : int
        As `uv_islands` numbers it.
    place : RoundPlace
        Circle or ellipse.
    faces : (f,) int64
        Faces of the mesh.
    corners : (c,) int64
        Their corners.
    point : (c,) int64
        Which of `z` each corner has.
    z : (t,) complex128
        The island's UV vertices in the unit disk.
    rim : (r,) int64
        Those of them on the circle.
    vertex : (t,) int64
        The mesh's vertices that they belong to.
    sides : (e, 2) int64
        Edges of the faces, pairs of z, each at least once.
    """

    number: int
    place: RoundPlace
    faces: Ints
    corners: Ints
    point: Ints
    z: NDArray[np.complex128]
    rim: Ints
    vertex: Ints
    sides: Ints

    def placed(self, moebius: Moebius) -> NDArray[np.float64]:
        """UVs (t, 2) of the UV vertices after a map of the unit disk onto itself."""
        moved = moebius(self.z)
        rim = moved[self.rim]
        moved[self.rim] = rim / np.abs(rim)
        return self.place.from_disk(moved)

    def moved(self, moebius: Moebius) -> NDArray[np.float64]:
        """UVs (c, 2) of the corners after it."""
        return self.placed(moebius).take(self.point, axis=0)

    def contains(self, uv: ArrayLike) -> bool:
        """Whether a point (2,) lies within the circle."""
        return bool(abs(self.place.to_disk(np.asarray(uv, dtype=np.float64).reshape(1, 2))[0]) < 1.0)


def disk_islands(mesh: PolygonMesh, corner_uv: ArrayLike, faces: ArrayLike | None = None) -> list[DiskIsland]:
    """The islands of a stored UV map that are maps onto a disk.

    Parameters
    ----------
    mesh : PolygonMesh
    corner_uv : (k, 2) floats
    faces : (p,) bool, optional
        Faces that count; by default all.

    Returns
    -------
    list of DiskIsland
        Of an island with holes the outermost boundary counts. Boundaries of four vertices or fewer do not tell.

    Raises
    ------
    OptionError
        Arrays that do not fit the mesh.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> rim = np.exp(1j * np.linspace(0, 2 * np.pi, 9)[:-1])
    >>> uv = 0.5 + 0.5 * np.column_stack((rim.real, rim.imag))
    >>> octagon = cuv.PolygonMesh(np.zeros((8, 3)), np.arange(8), np.array([0, 8]))
    >>> (island,) = cuv.disk_islands(octagon, uv)
    >>> moved = island.moved(cuv.Moebius.of_disk(center=0.3 + 0.2j, rotation=0.5))
    >>> bool(np.allclose(np.hypot(*(moved - 0.5).T), 0.5))
    True
    """
    found = uv_islands(mesh, corner_uv, faces)
    of_corner, follow = np.repeat(found.island, mesh.sizes), following_corners(mesh)
    places = ((number, rim, fitted_place(found.uv[rim], TOLERANCE)) for number, rim in _outer_rims(mesh, found))
    return [
        _island(found, number, np.flatnonzero(of_corner == number), follow, rim, place)
        for number, rim, place in places
        if place is not None
    ]


def _outer_rims(mesh: PolygonMesh, found: UVIslands) -> list[tuple[int, Ints]]:
    """Of each island the UV vertices of the boundary loop that reaches farthest to the left."""
    on_rim = np.flatnonzero(found.rim)
    if not len(on_rim):
        return []
    number = np.cumsum(found.rim) - 1
    a, b = number[found.rim_sides].T
    joined = csr_array((np.ones(len(a), dtype=bool), (a, b)), shape=(len(on_rim), len(on_rim)))
    loop = connected_components(joined, directed=False)[1]
    island = found.island_of_points(mesh)[on_rim]
    order = np.lexsort((found.uv[on_rim, 0], island))
    leftmost = order[np.flatnonzero(np.diff(island[order], prepend=-1))]
    members = np.argsort(loop, kind="stable")
    starts = np.searchsorted(loop[members], np.arange(loop.max() + 2))
    return [
        (int(island[point]), on_rim[members[starts[loop[point]] : starts[loop[point] + 1]]])
        for point in leftmost.tolist()
    ]


def _island(found: UVIslands, number: int, corners: Ints, follow: Ints, rim: Ints, place: RoundPlace) -> DiskIsland:
    points, point = np.unique(found.point[corners], return_inverse=True)
    local = np.empty(len(found.vertex), dtype=np.int64)
    local[points] = np.arange(len(points))
    return DiskIsland(
        number=number,
        place=place,
        faces=np.flatnonzero(found.island == number),
        corners=corners,
        point=point,
        z=place.to_disk(found.uv[points]),
        rim=local[rim],
        vertex=found.vertex[points],
        sides=np.column_stack((point, local[found.point[follow[corners]]])),
    )
