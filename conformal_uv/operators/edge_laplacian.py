"""The Laplacian of a surface as weighted edges: of its own triangles, or of its intrinsic Delaunay triangulation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..mesh.geometry import TriangleGeometry
from ..mesh.halfedges import HalfEdges, sorted_pairs
from ..mesh.manifold import check_areas
from ..options import Laplacian
from .intrinsic_delaunay import EFFORT, IntrinsicTriangulation, intrinsic_delaunay
from .laplacian import cotangent_weights
from .mollification import mollified

__all__ = ["EdgeLaplacian", "cotan_edges", "edge_laplacian", "intrinsic_delaunay_edges", "uniform_edges"]

LEAST = 1e-12  # weight around a vertex that would have none
ROUNDING = 1e-14  # a weight above minus this is 0 to rounding: the four vertices lie on a circle


@dataclass(frozen=True, eq=False)
class EdgeLaplacian:
    """``1/2 x' L x = 1/2 sum_e w_e (x_lo - x_hi)^2``.

    Attributes
    ----------
    lo, hi : (e,) int32
        Vertices of each edge, lo < hi, sorted.
    weights : (e,) float64
    kind : {"cotan", "intrinsic-delaunay", "uniform"}
    corners : (3, m) int32 or None
        The triangles whose cotangents they are; None for the surface's own.
    """

    lo: NDArray[np.int32]
    hi: NDArray[np.int32]
    weights: NDArray[np.float64]
    kind: str
    corners: NDArray[np.int32] | None = None

    def energy(self, z: NDArray[np.complex128]) -> float:
        """Dirichlet energy of a complex function on the vertices."""
        step = z[self.lo] - z[self.hi]
        return 0.5 * float(self.weights @ (step.real**2 + step.imag**2))


def edge_laplacian(
    corners: NDArray[np.int32],
    edges: HalfEdges,
    geometry: TriangleGeometry,
    n: int,
    kind: str = "auto",
    effort: int = EFFORT,
) -> EdgeLaplacian:
    """The Laplacian of the triangles ``corners`` (3, m) over n vertices.

    Parameters
    ----------
    kind : {"auto", "cotan", "intrinsic-delaunay"}
        "auto" is "cotan" where all faces have area and no interior edge a negative weight, else
        "intrinsic-delaunay".
    effort : int
        As in `intrinsic_delaunay`.

    Raises
    ------
    OptionError
        An unknown kind.
    DegenerateFaceError
        "cotan" on faces without area.
    """
    kind = Laplacian.of("laplacian", kind)
    if kind is Laplacian.COTAN:
        check_areas(geometry)
        return cotan_edges(edges, geometry)
    if kind is Laplacian.AUTO and not len(geometry.degenerate):
        plain = cotan_edges(edges, geometry)
        if not ((plain.weights < -ROUNDING) & (edges.count == 2)).any():
            return plain
        return intrinsic_delaunay_edges(corners, edges, geometry, n, plain, effort)
    return intrinsic_delaunay_edges(corners, edges, geometry, n, effort=effort)


def cotan_edges(edges: HalfEdges, geometry: TriangleGeometry) -> EdgeLaplacian:
    """Cotangent weights of the triangles as they are."""
    return EdgeLaplacian(edges.lo, edges.hi, cotangent_weights(edges, geometry), "cotan")


def uniform_edges(edges: HalfEdges) -> EdgeLaplacian:
    """All weights 1."""
    return EdgeLaplacian(edges.lo, edges.hi, np.ones(len(edges.lo)), "uniform")


def intrinsic_delaunay_edges(
    corners: NDArray[np.int32],
    edges: HalfEdges,
    geometry: TriangleGeometry,
    n: int,
    plain: EdgeLaplacian | None = None,
    effort: int = EFFORT,
) -> EdgeLaplacian:
    """Cotangent weights of the intrinsic Delaunay triangulation: non-negative inside, unless its flips were ended.

    Parameters
    ----------
    plain : EdgeLaplacian, optional
        The weights of the triangles as they are, where they are at hand. They tell which edges are not Delaunay,
        and stay where nothing is flipped.
    """
    lengths = geometry.side_lengths()
    safe = mollified(lengths)
    if safe is not lengths or len(geometry.degenerate):
        delaunay = intrinsic_delaunay(corners, safe, edges.twin, effort=effort)
        return _sorted(*_edges_around(delaunay, np.arange(corners.shape[1])), n, delaunay.corners)
    plain = plain or cotan_edges(edges, geometry)
    negative = (plain.weights < 0.0) & (edges.count == 2)
    suspects = np.flatnonzero(negative.take(edges.edge))
    suspects = suspects[suspects < edges.twin.take(suspects)]
    delaunay = intrinsic_delaunay(corners, lengths, edges.twin, geometry=geometry, suspects=suspects, effort=effort)
    stays = np.ones(len(edges.lo), dtype=bool)
    stays[edges.edge.reshape(corners.shape).take(delaunay.changed, axis=1)] = False
    weights = plain.weights[stays]
    if delaunay.finished:
        weights[negative[stays]] = 0.0  # Delaunay to rounding, where nothing was flipped
    lo, hi, fresh = _edges_around(delaunay, delaunay.changed)
    lo, hi = np.concatenate((edges.lo[stays], lo)), np.concatenate((edges.hi[stays], hi))
    return _sorted(lo, hi, np.concatenate((weights, fresh)), n, delaunay.corners)


def _edges_around(
    delaunay: IntrinsicTriangulation, faces: NDArray[np.int64]
) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]]:
    """Both vertices of the edges of some of the faces, and half the sum of the cotangents opposite to each edge."""
    corners, cot, m = delaunay.corners, delaunay.cotangents, delaunay.corners.shape[1]
    here = np.zeros(m, dtype=bool)
    here[faces] = True
    half_edge = (np.arange(3)[:, None] * m + faces).reshape(-1)
    other = delaunay.twin.take(half_edge)
    told = (other >= 0) & (other < half_edge) & here.take(other % m)  # by the face on the other side
    tail = corners.take(faces, axis=1)
    lo, hi = tail.reshape(-1), tail[[1, 2, 0]].reshape(-1)
    weights = cot.take(faces, axis=1)[[2, 0, 1]].reshape(-1)  # the corner opposite to half-edge c is c + 2
    inner = other >= 0
    weights += np.where(inner, cot.reshape(-1).take((other + 2 * m) % (3 * m)), 0.0)
    weights *= 0.5
    if delaunay.finished:
        weights[inner & (weights < 0.0)] = 0.0  # Delaunay to rounding: the four vertices lie on a circle
    taken = ~told & (lo != hi)  # an edge from a vertex to itself carries nothing
    lo, hi = lo[taken], hi[taken]
    return np.minimum(lo, hi), np.maximum(lo, hi), weights[taken]


def _sorted(
    lo: NDArray[np.int32], hi: NDArray[np.int32], weights: NDArray[np.float64], n: int, corners: NDArray[np.int32]
) -> EdgeLaplacian:
    """The edges in order, those between the same two vertices taken together."""
    order = sorted_pairs(lo, hi, n)
    lo, hi, weights = lo.take(order), hi.take(order), weights.take(order)
    again = np.flatnonzero((lo[1:] == lo[:-1]) & (hi[1:] == hi[:-1])) + 1
    if len(again):
        first = np.delete(np.arange(len(lo)), again)
        lo, hi, weights = lo[first], hi[first], np.add.reduceat(weights, first)
    positive = weights > 0.0
    held = np.zeros(n, dtype=bool)
    held[lo[positive]] = held[hi[positive]] = True
    if not held.all():  # the tips of needles: all their cotangents are lost to rounding
        weights = np.where(held[lo] & held[hi], weights, np.maximum(weights, LEAST))
    return EdgeLaplacian(lo, hi, weights, "intrinsic-delaunay", corners)
