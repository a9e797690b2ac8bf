"""The intrinsic Delaunay triangulation of a triangle mesh, by edge flips on lengths alone.

A. Bobenko, B. Springborn, "A discrete Laplace-Beltrami operator for simplicial surfaces", 2007: flipping edges with
cot a + cot b < 0 ends in a triangulation of the same surface on which every cotangent weight is non-negative. Edges
are flipped in batches, no two of which share a face.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..mesh.geometry import TriangleGeometry
from .laplacian import intrinsic_geometry

__all__ = ["IntrinsicTriangulation", "intrinsic_delaunay"]

Index = NDArray[np.int32]
Real = NDArray[np.float64]

EPS = np.finfo(np.float64).eps
MOST_ROUNDS = 10_000
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
    """

    corners: Index
    lengths: Real
    twin: Index
    cotangents: Real
    changed: NDArray[np.int64]
    flips: int


def intrinsic_delaunay(
    corners: Index,
    lengths: Real,
    twin: Index,
    *,
    geometry: TriangleGeometry | None = None,
    suspects: NDArray[np.integer] | None = None,
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

    Where triangles are too thin for doubles the flips may not end; some edges are then left that are not Delaunay.
    """
    if geometry is None:
        area2, cot = _areas_and_cotangents(lengths)
    else:
        area2, cot = geometry.double_area.copy(), geometry.dot / geometry.double_area
    work = _Flipper(corners.copy(), lengths.copy(), twin.copy(), area2, cot)
    if suspects is None:
        suspects = np.flatnonzero(twin >= 0)
        suspects = suspects[suspects < twin[suspects]]
    candidates = suspects.astype(np.int32)
    for _ in range(MOST_ROUNDS):
        bad, sums = work.not_delaunay(candidates)
        if not len(bad):
            break
        chosen = work.independent(bad, sums)
        candidates = work.flip(bad[chosen], bad[~chosen])
    else:  # triangles too thin for doubles: rounding has the better of the flips
        log.warning("%d edges are not Delaunay after %d flips", len(bad), work.flips)
    return IntrinsicTriangulation(
        work.corners, work.lengths, work.twin, work.cot, np.flatnonzero(work.touched), work.flips
    )


class _Flipper:
    """The triangulation in work. Half-edge c m + f is that of corner c of face f."""

    def __init__(self, corners: Index, lengths: Real, twin: Index, area2: Real, cot: Real) -> None:
        self.corners, self.lengths, self.twin, self.cot = corners, lengths, twin, cot
        self.m = corners.shape[1]
        self.flips = 0
        self.touched = np.zeros(self.m, dtype=bool)
        self._area2 = area2
        self._moved = np.full(3 * self.m, -1, dtype=np.int32)
        self._rank = np.empty(self.m, dtype=np.int64)

    def _across(self, h: Index) -> Index:
        """The half-edge whose corner lies opposite to half-edge h."""
        return (h + np.int32(2 * self.m)) % np.int32(3 * self.m)

    def not_delaunay(self, h: Index) -> tuple[Index, Real]:
        """Those of the half-edges whose edge has cot a + cot b < 0, and the sums.

        An edge with one face on both of its sides is none of them: two angles of one triangle sum to less than pi, and
        rounding, which is monotone, makes no sum of their cotangents negative.
        """
        cot = self.cot.reshape(-1)
        t = self.twin[h]
        here, there = cot[self._across(h)], cot[self._across(t)]
        total = here + there
        tolerance = 8.0 * EPS * (np.abs(here) + np.abs(there) + 1.0)
        bad = total < -tolerance
        return h[bad], total[bad]

    def independent(self, h: Index, sums: Real) -> NDArray[np.bool_]:
        """A choice of edges no two of which share a face: those that are the worst of both of their faces."""
        rank = np.empty(len(h), dtype=np.int64)
        rank[np.argsort(sums, kind="stable")] = np.arange(len(h))
        f, g = h % self.m, self.twin[h] % self.m
        self._rank[f] = self._rank[g] = len(h)
        np.minimum.at(self._rank, f, rank)
        np.minimum.at(self._rank, g, rank)
        return (self._rank[f] == rank) & (self._rank[g] == rank)

    def flip(self, h: Index, waiting: Index) -> Index:
        """Flip independent edges; return the half-edges to look at next, one an edge.

        Faces (a, b, c) and (b, a, d) on edge ab become (d, b, c) and (c, a, d).
        """
        m, three = np.int32(self.m), np.int32(3 * self.m)
        corner, length = self.corners.reshape(-1), self.lengths.reshape(-1)
        t = self.twin[h]
        f, g = h % m, t % m
        bc, ca, ad, db = (h + m) % three, self._across(h), (t + m) % three, self._across(t)
        a, b, c, d = corner[h], corner[t], corner[ca], corner[db]
        l_ab, l_bc, l_ca, l_ad, l_db = length[h], length[bc], length[ca], length[ad], length[db]
        along_c = 0.5 * (l_ab + (l_ca - l_bc) * (l_ca + l_bc) / l_ab)
        along_d = 0.5 * (l_ab + (l_ad - l_db) * (l_ad + l_db) / l_ab)
        l_cd = np.hypot(along_c - along_d, (self._area2[f] + self._area2[g]) / l_ab)

        old = np.concatenate((db, bc, ca, ad))
        new = np.concatenate((f, f + m, g, g + m))
        outside = self.twin[old]
        self._moved[old] = new
        outside = self._followed(outside)
        waiting = self._followed(waiting)
        self._moved[old] = -1
        corner[f], corner[g] = d, c
        corner[f + m], corner[g + m] = b, a
        corner[f + 2 * m], corner[g + 2 * m] = c, d
        length[new], length[f + 2 * m], length[g + 2 * m] = np.concatenate((l_db, l_bc, l_ca, l_ad)), l_cd, l_cd
        self.twin[new] = outside
        inner = outside >= 0
        self.twin[outside[inner]] = new[inner]
        self.twin[f + 2 * m], self.twin[g + 2 * m] = g + 2 * m, f + 2 * m

        both = np.concatenate((f, g))
        area2, cot = _areas_and_cotangents(self.lengths[:, both])
        self._area2[both], self.touched[both] = area2, True
        for row, values in zip(self.cot, cot, strict=True):
            row[both] = values
        self.flips += len(h)
        following = np.concatenate((waiting, new[inner]))
        following = np.sort(np.minimum(following, self.twin[following]))
        return following[np.diff(following, prepend=np.int32(-1)) > 0]

    def _followed(self, h: Index) -> Index:
        """Where half-edges are after the flips at hand; -1 stays -1."""
        moved = self._moved[h]
        return np.where((h >= 0) & (moved >= 0), moved, h)


def _areas_and_cotangents(lengths: Real) -> tuple[Real, Real]:
    """Doubled areas (m,), kept above rounding so that nothing is divided by 0, and cotangents (3, m)."""
    geometry = intrinsic_geometry(lengths)
    longest = lengths.max(axis=0)
    area2 = np.maximum(geometry.double_area, EPS * longest * longest)
    return area2, geometry.dot / area2
