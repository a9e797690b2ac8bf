"""An approximate inverse of the Dirichlet-to-Neumann map, from the strip of the mesh along its boundary.

What S = Lbb - Lbi Lii^-1 Lib does to waves as short as edges depends on the very triangles there: where boundary
vertices are spaced unevenly a Fourier multiplier knows nothing of it, and conjugate gradients take ten times as many
steps. The nearest rings of vertices are therefore kept as they are. What lies beyond them is met by longer waves only,
whose Dirichlet energy is that of the disk in any coordinate: it is replaced by rings of cells, each with half as many
as the one before and every cell as high as it is wide, numbered along the boundary. S^-1 r is then about the solution
of one small Neumann problem with the inflow r.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import SolverError
from ..linear.backends import linear_solver
from ..linear.linear_system import LowerTriangle
from .edge_laplacian import EdgeLaplacian

__all__ = ["SHORT", "NeumannStrip"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]

SHORT = 96  # boundary vertices, up to which a Fourier multiplier does as well
RINGS = 5  # of vertices that are kept; with more the steps stay as many
GROUP = 2  # vertices of the innermost ring to a cell
FEWEST = 4  # cells of a ring
# Conductances between the centres of square cells: to the next on the ring, and over 1 + 1/2 half widths to a cell
# twice as wide.
ALONG, ACROSS = 1.0, 2.0 / 3.0
LEAST = 1e-9  # of the median, for a weight that is not positive


class _Edges(NamedTuple):
    """Pairs of nodes and the conductances between them."""

    i: Ints
    j: Ints
    weights: Real


class NeumannStrip:
    """``S^-1 r`` for inflows r on the boundary, (nb,) or (nb, k), about; it is symmetric and positive definite.

    Parameters
    ----------
    laplacian : EdgeLaplacian
    boundary : (nb,) integers
        The boundary vertices, in their order.
    n : int
        Number of vertices.
    backend : {"auto", "cholmod", "superlu"}
    """

    def __init__(self, laplacian: EdgeLaplacian, boundary: Ints, n: int, backend: str = "auto") -> None:
        strip, inner = _strip(laplacian, boundary, n)
        rings, size = _rings(inner, strip.size)
        ground = np.zeros(size)  # constants come out large, and finite
        ground[-FEWEST if len(inner) else -1 :] = ALONG
        self._nb, self._size = len(boundary), size
        outer = np.maximum(strip.edges.i, strip.edges.j) < self._nb
        floor = _floor(laplacian.weights)
        try:  # edges on the boundary may well be negative: no flip could mend them
            weights = np.maximum(strip.edges.weights, np.where(outer, -np.inf, floor))
            self._solver = linear_solver(_matrix(strip.edges._replace(weights=weights), rings, ground), backend)
        except SolverError:  # parts of triangles are missing at the inner rim
            weights = np.maximum(strip.edges.weights, floor)
            self._solver = linear_solver(_matrix(strip.edges._replace(weights=weights), rings, ground), backend)

    def __call__(self, inflow: Real) -> Real:
        """Apply."""
        rhs = np.zeros((self._size, *inflow.shape[1:]))
        rhs[: self._nb] = inflow
        return self._solver.solve(rhs)[: self._nb]


class _Strip(NamedTuple):
    """Nodes: boundary vertices first, in their order; edges between them."""

    size: int
    edges: _Edges


class _Inner(NamedTuple):
    """Nodes of the strip with edges to what lies beyond, the place of each along the boundary, summed weights."""

    node: Ints
    angle: Real
    weights: Real

    def __len__(self) -> int:
        return len(self.node)


def _strip(laplacian: EdgeLaplacian, boundary: Ints, n: int) -> tuple[_Strip, _Inner]:
    """The first rings of vertices."""
    lo, hi = laplacian.lo, laplacian.hi
    number = np.full(n, -1, dtype=np.int64)
    size = len(boundary)
    number[boundary] = np.arange(size)
    turn = np.zeros(n, dtype=np.complex128)
    turn[boundary] = np.exp(2j * np.pi / size * np.arange(size))
    for _ in range(RINGS):
        kept = number >= 0
        crossing = np.flatnonzero(kept.take(lo) ^ kept.take(hi))
        out, back = _outward(lo.take(crossing), hi.take(crossing), kept)
        new, of = np.unique(out, return_inverse=True)
        ends = turn.take(back)
        turn[new] = np.bincount(of, ends.real) + 1j * np.bincount(of, ends.imag)
        number[new] = size + np.arange(len(new))
        size += len(new)
    kept = number >= 0
    at_lo, at_hi = kept.take(lo), kept.take(hi)
    both, crossing = np.flatnonzero(at_lo & at_hi), np.flatnonzero(at_lo ^ at_hi)
    _, back = _outward(lo.take(crossing), hi.take(crossing), kept)
    positive = np.maximum(laplacian.weights.take(crossing), _floor(laplacian.weights))
    beyond = np.bincount(number[back], positive, size)
    node = np.unique(number[back])
    angle = np.empty(size)
    angle[number[kept]] = np.angle(turn[kept])
    edges = _Edges(number[lo.take(both)], number[hi.take(both)], laplacian.weights.take(both))
    return _Strip(size, edges), _Inner(node, angle[node], beyond[node])


def _outward(
    lo: NDArray[np.int32], hi: NDArray[np.int32], kept: NDArray[np.bool_]
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Of edges with one end kept, the other end and that one."""
    inside = kept.take(lo)
    return np.where(inside, hi, lo), np.where(inside, lo, hi)


def _floor(weights: Real) -> float:
    """What negative weights are replaced by."""
    return LEAST * float(np.median(np.abs(weights[:: len(weights) // 8192 + 1])))


def _rings(inner: _Inner, first: int) -> tuple[_Edges, int]:
    """The cells beyond the strip, numbered from `first`, and the number of all nodes."""
    count = len(inner)
    place = np.empty(count, dtype=np.int64)
    place[np.argsort(inner.angle, kind="stable")] = np.arange(count)
    cells = max(count // GROUP, FEWEST) if count else 0
    parts = [_Edges(inner.node, first + place * cells // max(count, 1), inner.weights)]
    while cells:
        cell = np.arange(cells)
        parts.append(_Edges(first + cell, first + (cell + 1) % cells, np.full(cells, ALONG)))
        wider = max(cells // 2, FEWEST) if cells > FEWEST else 0
        if wider:
            parts.append(_Edges(first + cell, first + cells + cell * wider // cells, np.full(cells, ACROSS)))
        first, cells = first + cells, wider
    i, j, weights = (np.concatenate(columns) for columns in zip(*parts, strict=True))
    return _Edges(i, j, weights), first


def _matrix(strip: _Edges, rings: _Edges, ground: Real) -> LowerTriangle:
    """The Laplacian of all edges, with conductances to ground."""
    i, j, weights = (np.concatenate(parts) for parts in zip(strip, rings, strict=True))
    n = len(ground)
    column, row = np.minimum(i, j), np.maximum(i, j)
    diagonal = ground + np.bincount(i, weights, n) + np.bincount(j, weights, n)
    key, back = np.unique(np.concatenate((column * n + row, np.arange(n) * (n + 1))), return_inverse=True)
    data: Real = np.bincount(back, np.concatenate((-weights, diagonal))).astype(np.float64, copy=False)
    indptr = np.searchsorted(key, np.arange(n + 1) * n)
    return LowerTriangle(data, (key % n).astype(np.int32), indptr.astype(np.int64), passing=True)
