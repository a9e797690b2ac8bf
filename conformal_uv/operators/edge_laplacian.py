"""The Laplacian of a surface as weighted edges: of its own triangles, or of its intrinsic Delaunay triangulation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import OptionError
from ..mesh.geometry import TriangleGeometry
from ..mesh.halfedges import HalfEdges, half_edges
from ..mesh.manifold import check_areas, degenerate_faces
from .intrinsic_delaunay import intrinsic_delaunay
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
    if kind == "auto" and not len(degenerate_faces(geometry)):
        plain = cotan_edges(edges, geometry)
        if not (plain.weights[edges.count == 2] < -ROUNDING).any():
            return plain
    return intrinsic_delaunay_edges(corners, edges.twin, geometry, n)


def cotan_edges(edges: HalfEdges, geometry: TriangleGeometry) -> EdgeLaplacian:
    """Cotangent weights of the triangles as they are."""
    return EdgeLaplacian(edges.lo, edges.hi, cotangent_weights(edges, geometry), "cotan")


def uniform_edges(edges: HalfEdges) -> EdgeLaplacian:
    """All weights 1."""
    return EdgeLaplacian(edges.lo, edges.hi, np.ones(len(edges.lo)), "uniform")


def intrinsic_delaunay_edges(
    corners: NDArray[np.int32], twin: NDArray[np.int32], geometry: TriangleGeometry, n: int
) -> EdgeLaplacian:
    """Cotangent weights of the intrinsic Delaunay triangulation: non-negative inside."""
    lengths = mollified(np.sqrt(np.maximum(geometry.squared_lengths, 0.0)))
    delaunay = intrinsic_delaunay(corners, lengths, twin)
    half = 0.5 * delaunay.cotangents[[2, 0, 1]].reshape(-1)
    inner = np.flatnonzero(delaunay.twin >= 0)
    pair = half[inner] + half[delaunay.twin[inner]]
    half[inner[pair < 0.0]] = 0.0  # Delaunay to rounding: the four vertices lie on a circle
    joined = half_edges(delaunay.corners, n)
    weights = np.bincount(joined.edge, weights=half, minlength=len(joined.lo))
    proper = joined.lo != joined.hi  # an edge from a vertex to itself carries nothing
    return EdgeLaplacian(joined.lo[proper], joined.hi[proper], weights[proper], "intrinsic-delaunay")
