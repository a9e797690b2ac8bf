"""The intrinsic Delaunay triangulation of a triangle mesh, by edge flips on lengths alone.

A. Bobenko, B. Springborn, "A discrete Laplace-Beltrami operator for simplicial surfaces", 2007: flipping edges with
cot a + cot b < 0 ends in a triangulation of the same surface on which every cotangent weight is non-negative. Edges
are flipped in batches, no two of which share a face, or one by one where each waits for the one before.

A mesh takes about half a flip a face, fans of thousands of triangles a few. Two rows of vertices along one another
that thin triangles join askew take as many flips as there are triangles between where they are joined and where they
ought to be, in whatever order: the square of their number. So flips end after a number that no other mesh needs.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..mesh.geometry import TriangleGeometry
from .edge_flips import EdgeFlips, areas_and_cotangents
from .single_flips import flip_one_by_one

__all__ = ["EFFORT", "IntrinsicTriangulation", "intrinsic_delaunay"]

Index = NDArray[np.int32]
Real = NDArray[np.float64]

FEW = 32  # edges, which are flipped as fast one by one
MANY = 1000  # flips one by one, before it is seen whether many can be flipped at once again
SLOWER = 8  # times, is a flip of its own
EFFORT, LEAST_FLIPS = 16, 1_000_000  # flips a face, and what any mesh may take
log = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class IntrinsicTriangulation:
    """Triangles given by edge lengths; edges are geodesics of the surface, and two may join the same vertices.

    Attributes
    ----------
    corners : (3, m) int32
    lengths : (3, m) float64
        Of half-edge c, from corner c to corner c + 1.
    twin : (3 m,) int32
        As in HalfEdges.
    cotangents : (3, m) float64
        Of every corner's angle.
    changed : (k,) int64
        Faces that are not as they were.
    flips : int
        Edges flipped to get here.
    finished : bool
        Whether all edges are Delaunay. Where they are not, negative weights are left, which are as true to the surface.
    """

    corners: Index
    lengths: Real
    twin: Index
    cotangents: Real
    changed: NDArray[np.int64]
    flips: int
    finished: bool = True


def intrinsic_delaunay(
    corners: Index,
    lengths: Real,
    twin: Index,
    *,
    geometry: TriangleGeometry | None = None,
    suspects: NDArray[np.integer] | None = None,
    effort: int = EFFORT,
) -> IntrinsicTriangulation:
    """Flip edges until all are Delaunay (to rounding); boundary edges stay.

    Parameters
    ----------
    corners : (3, m) int32
    lengths : (3, m) float64
        Half-edge lengths that satisfy the triangle inequality strictly.
    twin : (3 m,) int32
    geometry : TriangleGeometry, optional
        Of triangles with these lengths, all with area, where it is at hand.
    suspects : (k,) integers, optional
        Half-edges, one for each edge that may be not Delaunay; by default all inner edges.
    effort : int
        Most flips, about, times the number of faces; a million are made in any case.
    """
    if geometry is None:
        area2, cot = areas_and_cotangents(lengths)
    else:
        area2, cot = geometry.double_area.copy(), geometry.cotangents()
    work = EdgeFlips(corners.copy(), lengths.copy(), twin.copy(), area2, cot)
    if suspects is None:
        suspects = np.flatnonzero(twin >= 0)
        suspects = suspects[suspects < twin[suspects]]
    candidates = suspects.astype(np.int32)
    left = max(LEAST_FLIPS, effort * work.m)
    while len(candidates) and left > 0:
        bad, sums = work.not_delaunay(candidates)
        if not len(bad):
            candidates = candidates[:0]
            continue
        chosen = work.independent(bad, sums)
        before = work.flips
        if np.count_nonzero(chosen) < min(FEW, len(bad)):
            candidates = flip_one_by_one(work, bad, min(4 * len(bad) + MANY, left // SLOWER + 1))
            left -= SLOWER * (work.flips - before)
        else:
            candidates = work.flip(bad[chosen], bad[~chosen])
            left -= work.flips - before
    if len(candidates):
        log.info("%d edges may be not Delaunay after %d flips", len(candidates), work.flips)
    changed, finished = np.flatnonzero(work.touched), not len(candidates)
    return IntrinsicTriangulation(work.corners, work.lengths, work.twin, work.cotangents, changed, work.flips, finished)
