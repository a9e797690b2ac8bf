"""A surface: the checked, immutable form in which a triangle mesh goes through the whole package."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..concise import Concise
from . import refusals
from .arrays import check_referenced, face_array, on_one_line, scaled, vertex_array
from .geometry import TriangleGeometry, triangle_geometry
from .halfedges import HalfEdges, half_edges
from .loops import boundary_loops
from .manifold import (
    check_edges,
    check_fans,
    check_orientation,
    face_components,
    is_face_connected,
)

__all__ = ["Surface"]


@dataclass(frozen=True, eq=False, repr=False)
class Surface(Concise):
    """An oriented 2-manifold triangle mesh, every vertex used. Its arrays are not writeable.

    Attributes
    ----------
    V : (n, 3) float64
        Vertex positions, scaled by a power of two so that the largest coordinate lies in [1/2, 1).
    corners : (3, m) int32
        Vertex of each face's corners.
    edges : HalfEdges
    geometry : TriangleGeometry
        Of the scaled positions.
    loops : list of (k,) int64
        Boundary loops in the direction of the faces; the first starts at the first boundary half-edge met when
        faces are read in order.
    pieces : int
        Number of connected components.
    unit : float
        Length of one unit of V in the units of the positions as given.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> surface = cuv.Surface.from_arrays([[0, 0, 0], [3, 0, 0], [0, 3, 0]], [[0, 1, 2]])
    >>> surface.n, surface.euler_characteristic, surface.require_disk().tolist(), surface.unit
    (3, 1, [0, 1, 2], 4.0)
    """

    V: NDArray[np.float64]
    corners: NDArray[np.int32]
    edges: HalfEdges
    geometry: TriangleGeometry
    loops: list[NDArray[np.int64]]
    pieces: int
    unit: float

    def __post_init__(self) -> None:
        edges, geometry = self.edges, self.geometry
        held: list[NDArray[Any]] = [self.V, self.corners, geometry.dot, geometry.double_area, *self.loops]
        for array in [*held, edges.lo, edges.hi, edges.edge, edges.count, edges.twin]:
            array.setflags(write=False)

    @classmethod
    def from_arrays(cls, V: ArrayLike, F: ArrayLike) -> Surface:
        """Check a mesh and take it in.

        Parameters
        ----------
        V : (n, 3) floats, any units
        F : (m, 3) integers, 0-based

        Raises
        ------
        MeshError
            Or the subclass that names what is wrong, with the indices.
        """
        vertices = vertex_array(V)
        n = len(vertices)
        corners = face_array(F, n)
        check_referenced(corners, n)
        edges = half_edges(corners, n)
        check_edges(corners, edges)
        check_orientation(corners, edges)
        _check_boundary(corners, edges, n)
        loops = boundary_loops(corners, edges.twin)
        pieces = 1
        euler = n - len(edges.lo) + corners.shape[1]
        # A piece connected through its faces whose Euler number is the largest its loops allow (1 for one loop,
        # 2 for none) has no handle and no two fans at a vertex: each would lower the number. Only other meshes
        # need the search for fans.
        if len(loops) + euler != 2 or len(loops) > 1 or not is_face_connected(corners, edges):
            check_fans(corners, edges, n)
            pieces, _ = face_components(corners, n)
        vertices, unit = scaled(vertices)
        return cls(vertices, corners, edges, triangle_geometry(vertices, corners), loops, pieces, unit)

    def without_vertex(self, vertex: int) -> tuple[Surface, NDArray[np.int64]]:
        """A closed surface without the star of a vertex, and the vertices that are left, in their order."""
        kept = np.delete(np.arange(self.n), vertex)
        number = np.full(self.n, -1, dtype=np.int32)
        number[kept] = np.arange(len(kept), dtype=np.int32)
        faces = np.flatnonzero((self.corners != vertex).all(axis=0))
        return self._changed(self.V[kept], number[self.corners[:, faces]], faces), kept

    def without_face(self, face: int) -> Surface:
        """A closed surface without one of its faces."""
        faces = np.delete(np.arange(self.m), face)
        return self._changed(self.V, self.corners[:, faces], faces)

    def capped(self) -> Surface:
        """The surface with its loops closed by a vertex in the middle of each, joined to all of the loop.

        The caps' vertices and faces follow its own.
        """
        V, corners = [self.V], [self.corners]
        for number, loop in enumerate(self.loops):
            apex = np.full(len(loop), self.n + number)
            V.append(self.V[loop].mean(axis=0, keepdims=True))
            corners.append(np.stack((np.roll(loop, -1), loop, apex)).astype(np.int32))
        return self._changed(np.concatenate(V), np.concatenate(corners, axis=1))

    def _changed(
        self, V: NDArray[np.float64], corners: NDArray[np.int32], kept: NDArray[np.int64] | None = None
    ) -> Surface:
        """Other vertices and faces of the same pieces, known to be a manifold; `kept` where the faces are some of
        this surface's."""
        edges = half_edges(corners, len(V))
        if kept is None:
            geometry = triangle_geometry(V, corners)
        else:
            geometry = TriangleGeometry(self.geometry.dot[:, kept], self.geometry.double_area[kept])
        return Surface(V, corners, edges, geometry, boundary_loops(corners, edges.twin), self.pieces, self.unit)

    @property
    def degenerate(self) -> NDArray[np.int64]:
        """Faces whose area is lost to rounding."""
        return self.geometry.degenerate

    @property
    def n(self) -> int:
        """Number of vertices."""
        return len(self.V)

    @property
    def m(self) -> int:
        """Number of faces."""
        return self.corners.shape[1]

    @property
    def F(self) -> NDArray[np.int32]:
        """Faces, (m, 3)."""
        return self.corners.T

    @property
    def euler_characteristic(self) -> int:
        """Vertices minus edges plus faces."""
        return self.n - len(self.edges.lo) + self.m

    @property
    def genus(self) -> int:
        """Number of handles, summed over the pieces: chi = 2 pieces - 2 genus - loops."""
        return (2 * self.pieces - len(self.loops) - self.euler_characteristic) // 2

    def require_disk(self) -> NDArray[np.int64]:
        """The boundary loop of a topological disk.

        Raises
        ------
        DisconnectedError, TopologyError
            Saying what the surface is instead.
        """
        if self.pieces > 1:
            raise refusals.several_pieces(self.pieces)
        if not self.loops:
            raise refusals.closed(self.genus)
        if len(self.loops) > 1:
            raise refusals.several_loops(self.loops, [self.loop_length(loop) for loop in self.loops], self.genus)
        if self.genus:
            raise refusals.handles(self.genus)
        return self.loops[0]

    def require_extent(self) -> None:
        """Raise DegenerateFaceError where all vertices lie on one line: no angle is there to be kept."""
        if on_one_line(self.V):
            raise refusals.no_extent(self.m)

    def loop_length(self, loop: NDArray[np.int64]) -> float:
        """Length of a closed polygon of vertices, in the scaled units."""
        return float(np.linalg.norm(self.V[loop] - self.V[np.roll(loop, -1)], axis=1).sum())


def _check_boundary(corners: NDArray[np.int32], edges: HalfEdges, n: int) -> None:
    """Raise NonManifoldError where two stretches of boundary meet in a vertex."""
    leaving = np.bincount(corners.reshape(-1)[edges.twin == -1], minlength=n)
    bad = np.flatnonzero(leaving > 1)
    if len(bad):
        raise refusals.pinched_boundary(bad)
