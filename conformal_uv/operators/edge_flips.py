"""Edges of an intrinsic triangulation flipped many at once, on lengths alone.

Half-edge ``c m + f`` is that of corner c of face f. What a round costs goes with the edges that it looks at, whatever
the size of the mesh.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.blocks import by_blocks
from .laplacian import intrinsic_geometry

__all__ = ["EdgeFlips", "areas_and_cotangents"]

Index = NDArray[np.int32]
Places = NDArray[np.intp]
Real = NDArray[np.float64]

EPS = float(np.finfo(np.float64).eps)
TOLERANCE = 8.0 * EPS  # of the two cotangents, by which an edge that is Delaunay may come out as none


class EdgeFlips:
    """A triangulation in work. The arrays belong to it from now on.

    Parameters
    ----------
    corners : (3, m) int32
    lengths : (3, m) float64
    twin : (3 m,) int32
    double_area : (m,) float64
    cotangents : (3, m) float64
    """

    def __init__(self, corners: Index, lengths: Real, twin: Index, double_area: Real, cotangents: Real) -> None:
        # Written to as flat arrays too: a part of some geometry's columns may lie in memory the other way around.
        self.corners, self.lengths = np.ascontiguousarray(corners), np.ascontiguousarray(lengths)
        self.twin, self.double_area, self.cotangents = twin, double_area, np.ascontiguousarray(cotangents)
        self.m = corners.shape[1]
        self.flips = 0
        self.touched = np.zeros(self.m, dtype=bool)
        self._moved = np.full(3 * self.m, -1, dtype=np.int32)
        self._worst = np.empty(self.m)
        self._first = np.empty(self.m, dtype=np.intp)

    def not_delaunay(self, half_edges: Index) -> tuple[Places, Real]:
        """Those of the half-edges whose edge can be flipped and has cot a + cot b < 0, and the sums."""
        cot = self.cotangents.reshape(-1)

        def found(part: slice) -> tuple[Places, Real]:
            h = half_edges[part].astype(np.intp)
            t = self.twin.take(h).astype(np.intp)
            here, there = cot.take(self._across(h)), cot.take(self._across(t))
            total = here + there
            bad = total < -TOLERANCE * (np.abs(here) + np.abs(there) + 1.0)
            bad &= self._face(h) != self._face(t)
            return h[bad], total[bad]

        edges, sums = zip(*by_blocks(found, len(half_edges)), strict=True)
        return np.concatenate(edges), np.concatenate(sums)

    def independent(self, h: Places, sums: Real) -> NDArray[np.bool_]:
        """A choice of edges no two of which share a face: those that are the worst of both of their faces, the first of
        those that are alike."""
        f, g = self._face(h), self._face(self.twin.take(h).astype(np.intp))
        worst, first = self._worst, self._first
        worst[f] = worst[g] = np.inf
        np.minimum.at(worst, f, sums)
        np.minimum.at(worst, g, sums)
        lead = np.flatnonzero((worst.take(f) == sums) & (worst.take(g) == sums))
        f, g = f[lead], g[lead]
        first[f] = first[g] = len(sums)
        np.minimum.at(first, f, lead)
        np.minimum.at(first, g, lead)
        chosen = np.zeros(len(sums), dtype=bool)
        chosen[lead[(first.take(f) == lead) & (first.take(g) == lead)]] = True
        return chosen

    def flip(self, h: Places, waiting: Places) -> Index:
        """Flip independent edges; return the half-edges to look at next, one an edge.

        Faces (a, b, c) and (b, a, d) on edge ab become (d, b, c) and (c, a, d).
        """
        k, m = len(h), self.m
        old, new = np.empty((4, k), dtype=np.intp), np.empty((4, k), dtype=np.intp)
        outside = np.empty((4, k), dtype=np.int32)

        def turn(part: slice) -> None:
            f, g = self._turned(h[part], old[:, part])
            new[0, part], new[1, part], new[2, part], new[3, part] = f, f + m, g, g + m
            outside[:, part] = self.twin.take(old[:, part])
            self._moved[old[:, part]] = new[:, part]

        def join(part: slice) -> None:
            at, beside = new[:, part], self._followed(outside[:, part])
            outside[:, part] = beside
            self.twin[at] = beside
            inner = beside >= 0
            self.twin[beside[inner]] = at[inner]
            f, g = at[0] + 2 * m, at[2] + 2 * m
            self.twin[f], self.twin[g] = g, f

        by_blocks(turn, k)
        by_blocks(join, k)
        following = self._followed(waiting.astype(np.int32))
        self._moved[old] = -1
        self.flips += k
        following = np.concatenate((following, new[outside >= 0].astype(np.int32)))
        following = np.sort(np.minimum(following, self.twin.take(following)))
        return following[np.diff(following, prepend=np.int32(-1)) > 0]

    def _turned(self, h: Places, old: Places) -> tuple[Places, Places]:
        """Flip edges within their two faces, which come back; `old` (4, k) gets the half-edges around them as they were
        numbered: db, bc, ca, ad."""
        m = self.m
        corner, length = self.corners.reshape(-1), self.lengths.reshape(-1)
        t = self.twin.take(h).astype(np.intp)
        f, g = self._face(h), self._face(t)
        ca, db = self._across(h), self._across(t)
        bc, ad = self._across(ca), self._across(db)
        old[0], old[1], old[2], old[3] = db, bc, ca, ad
        a, b, c, d = corner.take(h), corner.take(t), corner.take(ca), corner.take(db)
        l_ab = length.take(h)
        l_db, l_bc, l_ca, l_ad = around = length.take(old)
        along_c = 0.5 * (l_ab + (l_ca - l_bc) * (l_ca + l_bc) / l_ab)
        along_d = 0.5 * (l_ab + (l_ad - l_db) * (l_ad + l_db) / l_ab)
        l_cd = np.hypot(along_c - along_d, (self.double_area.take(f) + self.double_area.take(g)) / l_ab)
        for face, tips, sides in ((f, (d, b, c), around[:2]), (g, (c, a, d), around[2:])):
            for place, tip in enumerate(tips):
                corner[face + place * m] = tip
            here = np.stack((*sides, l_cd))
            area, cot = areas_and_cotangents(here)
            for place in range(3):
                length[face + place * m] = here[place]
                self.cotangents[place][face] = cot[place]
            self.double_area[face], self.touched[face] = area, True
        return f, g

    def _followed(self, h: Index) -> Index:
        """Where half-edges are after the flips at hand; -1 stays -1."""
        moved = self._moved.take(np.maximum(h, 0))
        return np.where((h >= 0) & (moved >= 0), moved, h)

    def _across(self, h: Places) -> Places:
        """The half-edge whose corner lies opposite to half-edge h; it is also the one before h in its face."""
        return np.where(h < self.m, h + 2 * self.m, h - self.m)

    def _face(self, h: Places) -> Places:
        return h - self.m * ((h >= self.m).astype(np.intp) + (h >= 2 * self.m))


def areas_and_cotangents(lengths: Real) -> tuple[Real, Real]:
    """Doubled areas (m,), kept above rounding so that nothing is divided by 0, and cotangents (3, m)."""
    geometry = intrinsic_geometry(lengths)
    longest = np.maximum(np.maximum(lengths[0], lengths[1]), lengths[2])
    area2 = np.maximum(geometry.double_area, EPS * longest * longest)
    return area2, geometry.dot / area2
