"""A rank's part of a surface: its own vertices, all faces around them, and the vertices of those that others own.

What there is to know of an edge or a vertex is known where the vertex, or an end of the edge, is owned; so the
surface's checks and its Laplacian are the ordinary ones of a small mesh, and only what they find is put together.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..mesh import refusals
from ..mesh.geometry import TriangleGeometry, triangle_geometry
from ..mesh.halfedges import HalfEdges, half_edges
from .ranks import Ranks
from .shares import Borrowed, Shares
from .slices import MeshSlice

__all__ = ["Part", "distributed_part"]

Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Part:
    """Vertices are numbered locally: those owned first, in order, then those of other ranks, in order.

    Attributes
    ----------
    ranks : Ranks
    vertices, faces : Shares
        Of the whole surface.
    V : (k, 3) float64
        Scaled by one power of two for all ranks, `unit`.
    corners : (3, l) int32
    face : (l,) int64
        Which of the surface's faces these are, ascending.
    counted : (l,) bool
        Faces that this rank counts in sums: those whose first corner it owns.
    edges : HalfEdges
        Complete where an end is owned.
    geometry : TriangleGeometry
    ghosts : Borrowed
        The vertices of other ranks.
    """

    ranks: Ranks
    vertices: Shares
    faces: Shares
    V: NDArray[np.float64]
    corners: NDArray[np.int32]
    face: Ints
    counted: NDArray[np.bool_]
    edges: HalfEdges
    geometry: TriangleGeometry
    ghosts: Borrowed
    unit: float

    @property
    def own(self) -> int:
        """How many vertices this rank owns."""
        return self.vertices.last - self.vertices.first

    @property
    def size(self) -> int:
        """How many vertices there are here."""
        return len(self.V)

    def names(self, local: NDArray[Any]) -> Ints:
        """The surface's numbers of local vertices."""
        own = local < self.own
        ghosts = self.ghosts.numbers
        if not len(ghosts):
            return local.astype(np.int64) + self.vertices.first
        return np.where(own, local + self.vertices.first, ghosts[np.where(own, 0, local - self.own)])

    def with_ghosts(self, own: NDArray[Any]) -> NDArray[Any]:
        """Values of the own vertices followed by those of the others here."""
        return np.concatenate((own, self.ghosts.values(own)))

    def told_edges(self) -> tuple[NDArray[np.bool_], Ints, Ints]:
        """Which edges this rank tells of, the owner of the lower end doing so, and all edges' lower and higher name."""
        a, b = self.names(self.edges.lo), self.names(self.edges.hi)
        lo, hi = np.minimum(a, b), np.maximum(a, b)
        return self.vertices.owned(lo), lo, hi


def distributed_part(ranks: Ranks, mesh: MeshSlice) -> Part:
    """Send every face to the owners of its corners, and number what has come.

    Raises
    ------
    UnreferencedVertexError
    """
    vertices = mesh.vertices
    with ranks.agreed():
        to, row = _owners_of_corners(vertices, mesh.F)
    names = (mesh.faces.first + row).astype(mesh.F.dtype)
    face, around = ranks.exchanged(to, names, mesh.F[row])
    del to, row, names
    with ranks.agreed():
        order = np.argsort(face, kind="stable")
        face, around = face[order].astype(np.int64), around[order]
        own = vertices.owned(around)
        used = np.zeros(vertices.last - vertices.first, dtype=bool)
        used[around[own] - vertices.first] = True
    bad = ranks.indices(vertices.first + np.flatnonzero(~used))
    if len(bad):
        raise refusals.unreferenced(bad, vertices.count)
    with ranks.agreed():
        others = np.unique(around[~own]).astype(np.int64)
        corners = np.empty(around.T.shape, dtype=np.int32)
        count = vertices.last - vertices.first
        for corner, column, mine in zip(corners, around.T, own.T, strict=True):
            corner[mine] = column[mine] - vertices.first
            corner[~mine] = count + np.searchsorted(others, column[~mine])
        counted = own[:, 0].copy()
    del around, own
    ghosts = Borrowed(ranks, vertices, others)
    V, unit = _scaled(ranks, mesh.V)
    V = np.concatenate((V, ghosts.values(V)))
    with ranks.agreed():
        edges = half_edges(corners, len(V)) if corners.size else _no_edges()
        geometry = triangle_geometry(V, corners)
    return Part(ranks, vertices, mesh.faces, V, corners, face, counted, edges, geometry, ghosts, unit)


def _owners_of_corners(vertices: Shares, F: NDArray[Any]) -> tuple[Ints, Ints]:
    """To which ranks which faces go, each once to each."""
    a, b, c = (vertices.owner(column) for column in F.T)
    b_differs, c_differs = np.flatnonzero(b != a), np.flatnonzero((c != a) & (c != b))
    to = np.concatenate((a, b[b_differs], c[c_differs]))
    return to, np.concatenate((np.arange(len(F)), b_differs, c_differs))


def _scaled(ranks: Ranks, V: NDArray[np.float64]) -> tuple[NDArray[np.float64], float]:
    """As `mesh.arrays.scaled`, for all ranks together."""
    _, exponent = np.frexp(ranks.most(float(np.abs(V).max(initial=0.0))))
    exponent = min(int(exponent), 1023)
    return np.ldexp(V, -exponent), float(np.ldexp(1.0, exponent))


def _no_edges() -> HalfEdges:
    none = np.empty(0, dtype=np.int32)
    return HalfEdges(none, none, none, none.astype(np.int8), none)
