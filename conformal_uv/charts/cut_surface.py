"""Polygons joined across some of their sides: a surface cut open along the others."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..mesh.fans import corner_links, split_corners
from ..mesh.halfedges import joined_pairs

__all__ = ["CutSurface"]

Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class CutSurface:
    """Consistently wound polygons, corner by corner.

    Attributes
    ----------
    V : (n, 3) float64
    vertex : (k,) int64
        The vertex at each corner.
    follow : (k,) int64
        The next corner of the same polygon; side i runs from corner i to ``follow[i]``.
    polygon : (k,) int64
    twin : (k,) int64
        The side joined to each side, running the other way; -1 at the boundary.
    chart : (p,) int64
        The chart of each polygon.
    site : (k,) int64
        The vertex of the cut surface at each corner: a vertex counts once for every fan of polygons around it.
    vertex_of_site : (s,) int64
    real : int
        Number of polygons that are the caller's; those after them fill holes.
    """

    V: NDArray[np.float64]
    vertex: Ints
    follow: Ints
    polygon: Ints
    twin: Ints
    chart: Ints
    site: Ints
    vertex_of_site: Ints
    real: int

    @property
    def joined(self) -> tuple[Ints, Ints]:
        """Pairs of joined sides, each pair once."""
        return joined_pairs(self.twin)

    def side_lengths(self, sides: Ints) -> NDArray[np.float64]:
        """Lengths in the units of V over its largest coordinate."""
        scale = max(float(np.abs(self.V).max()), float(np.finfo(float).tiny))
        V = self.V / scale
        return np.asarray(np.linalg.norm(V[self.vertex[sides]] - V[self.vertex[self.follow[sides]]], axis=1))

    def with_twins(self, twin: Ints, touched: NDArray[np.bool_]) -> CutSurface:
        """The surface joined as `twin` says; sites are made anew at the `touched` vertices (n,) and where it was
        split before."""
        n = len(self.V)
        again = touched.copy()
        again[self.vertex_of_site[n:]] = True
        joined = replace(self, twin=twin)
        one, other = joined.joined
        near = again[self.vertex[one]] | again[self.vertex[self.follow[one]]]
        links = corner_links(self.vertex, self.follow, one[near], other[near])
        site, vertex_of_site = split_corners(self.vertex, *links, n, again)
        return replace(joined, site=site, vertex_of_site=vertex_of_site)

    def cut_along(self, sides: Ints) -> CutSurface:
        """The surface cut open along these sides and their twins."""
        twin = self.twin.copy()
        twin[twin[sides]] = -1
        twin[sides] = -1
        return self.with_twins(twin, self.touching(sides))

    def touching(self, sides: Ints) -> NDArray[np.bool_]:
        """The vertices at the ends of the sides, (n,)."""
        touched = np.zeros(len(self.V), dtype=bool)
        touched[self.vertex[sides]] = True
        touched[self.vertex[self.follow[sides]]] = True
        return touched
