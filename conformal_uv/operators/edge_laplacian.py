"""The Laplacian of a surface as weighted edges: of its own triangles, or of its intrinsic Delaunay triangulation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import OptionError
from ..mesh.geometry import TriangleGeometry
from ..mesh.halfedges import HalfEdges, sorted_pairs
from ..mesh.manifold import check_areas
from .intrinsic_delaunay import IntrinsicTriangulation, intrinsic_delaunay
from .laplacian import cotangent_weights
from .mollification import mollified

__all__ = ["LAPLACIANS", "EdgeLaplacian", "cotan_edges", "edge_laplacian", "intrinsic_delaunay_edges", "uniform_edges"]

LAPLACIANS = ("auto", "cotan", "intrinsic-delaunay")
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
    """

    lo: NDArray[np.int32]
    hi: NDArray[np.int32]
    weights: NDArray[np.float64]
    kind: str

    def energy(self, z: NDArray[np.complex128]) -> float:
        """Dirichlet energy of a complex function on the vertices."""
        step = z[self.lo] - z[self.hi]
        return 0.5 * float(self.weights @ (step.real**2 + step.imag**2))


def edge_laplacian(
    corners: NDArray[np.int32], edges: HalfEdges, geometry: TriangleGeometry, n: int, kind: str = "auto"
) -> EdgeLaplacian:
    """The Laplacian of the triangles ``corners`` (3, m) over n vertices.

    Parameters
    ----------
    kind : {"auto", "cotan", "intrinsic-delaunay"}
        "auto" is "cotan" where all faces have area and no interior edge a negative weight, else
        "intrinsic-delaunay".

    Raises
    ------
    OptionError
        An unknown kind.
    DegenerateFaceError
        "cotan" on faces without area.
    SolverError
        The edge flips do not end.
    """
    if kind not in LAPLACIANS:
        raise OptionError(f"laplacian is {kind!r}; choose {', '.join(LAPLACIANS)}.")
    if kind == "cotan":
        check_areas(geometry)
        return cotan_edges(edges, geometry)
    if len(geometry.degenerate):
        return intrinsic_delaunay_edges(corners, edges.twin, geometry, n)
    plain = cotan_edges(edges, geometry)
    negative = plain.weights < 0.0
    negative &= edges.count == 2
    if kind == "auto" and not (plain.weights[negative] < -ROUNDING).any():
        return plain
    return intrinsic_delaunay_edges(corners, edges.twin, geometry, n, suspects=np.flatnonzero(negative[edges.edge]))


def cotan_edges(edges: HalfEdges, geometry: TriangleGeometry) -> EdgeLaplacian:
    """Cotangent weights of the triangles as they are."""
    return EdgeLaplacian(edges.lo, edges.hi, cotangent_weights(edges, geometry), "cotan")


def uniform_edges(edges: HalfEdges) -> EdgeLaplacian:
    """All weights 1."""
    return EdgeLaplacian(edges.lo, edges.hi, np.ones(len(edges.lo)), "uniform")


def intrinsic_delaunay_edges(
    corners: NDArray[np.int32],
    twin: NDArray[np.int32],
    geometry: TriangleGeometry,
    n: int,
    *,
    suspects: NDArray[np.int64] | None = None,
) -> EdgeLaplacian:
    """Cotangent weights of the intrinsic Delaunay triangulation: non-negative inside.

    Parameters
    ----------
    suspects : (k,) int64, optional
        Half-edges that may be not Delaunay as the triangles are; by default all inner ones.
    """
    lengths = geometry.squared_lengths
    np.sqrt(np.maximum(lengths, 0.0, out=lengths), out=lengths)
    safe = mollified(lengths)
    if safe is not lengths:
        delaunay = intrinsic_delaunay(corners, safe, twin)
    else:
        if suspects is not None:
            suspects = suspects[suspects < twin[suspects]]
        delaunay = intrinsic_delaunay(corners, lengths, twin, geometry=geometry, suspects=suspects)
    return _edges_of(delaunay, n)


def _edges_of(delaunay: IntrinsicTriangulation, n: int) -> EdgeLaplacian:
    """Half the sum of the cotangents opposite to each edge, edges between the same two vertices taken together."""
    corners, twin = delaunay.corners, delaunay.twin
    one = np.flatnonzero((twin < 0) | (np.arange(len(twin), dtype=np.int32) < twin))
    tail, head = corners.reshape(-1).take(one), corners[[1, 2, 0]].reshape(-1).take(one)
    proper = tail != head  # an edge from a vertex to itself carries nothing
    if not proper.all():
        one, tail, head = one[proper], tail[proper], head[proper]
    opposite = delaunay.cotangents[[2, 0, 1]].reshape(-1)  # the corner opposite to half-edge c is c + 2
    other = twin.take(one)
    inner = other >= 0
    weights = opposite.take(one)
    weights += np.where(inner, opposite.take(other), 0.0)  # -1, on the boundary, takes the last, for nothing
    weights *= 0.5
    weights[inner & (weights < 0.0)] = 0.0  # Delaunay to rounding: the four vertices lie on a circle
    lo, hi = np.minimum(tail, head), np.maximum(tail, head)
    order = sorted_pairs(lo, hi, n)
    lo, hi, weights = lo.take(order), hi.take(order), weights.take(order)
    again = np.flatnonzero((lo[1:] == lo[:-1]) & (hi[1:] == hi[:-1])) + 1
    if len(again):
        first = np.delete(np.arange(len(lo)), again)
        lo, hi, weights = lo[first], hi[first], np.add.reduceat(weights, first)
    return EdgeLaplacian(lo, hi, weights, "intrinsic-delaunay")

