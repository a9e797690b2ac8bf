"""The triangles of every chart, numbered by themselves, ready to be mapped."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..mesh.geometry import triangle_geometry
from ..mesh.polygon_sides import edge_keys
from ..mesh.polygons import PolygonMesh
from ..mesh.triangulate import triangulate
from .cut_surface import CutSurface

__all__ = ["ChartMesh", "ChartMeshes", "chart_meshes"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ChartMesh:
    """One chart.

    Attributes
    ----------
    V : (n', 3) float64
        Positions; virtual vertices, in the middle of holes, come last.
    vertices : (n,) int64
        The caller's vertex of each vertex that is not virtual.
    F : (m, 3) int64
        Triangles of the caller's polygons, wound for the solution.
    polygon : (m,) int64
        The polygon of each triangle.
    corner : (m, 3) int64
        The corner of that polygon at each corner of the triangle, among the corners of all polygons.
    solved : (m', 3) int64
        The triangles that the map is solved on: F, with the virtual ones.
    solved_polygon : (m',) int64
        Their polygons.
    """

    V: Real
    vertices: Ints
    F: Ints
    polygon: Ints
    corner: Ints
    solved: Ints
    solved_polygon: Ints


@dataclass(frozen=True, eq=False)
class ChartMeshes:
    """All charts, one after another in shared arrays.

    Attributes
    ----------
    V, site, F, polygon, corner, solved, solved_polygon
        As in ChartMesh, of all charts; `site` (n,) is the site of each vertex, at least the number of sites for
        virtual ones.
    vertex_of_site : (s,) int64
    first_vertex, first_virtual, first_face, first_solved : (count + 1,) int64
        Where each chart begins; `first_virtual` where its virtual vertices do.
    area : (count,) float64
        Surface area of each chart's own triangles, over the largest coordinate squared.
    unit : float
        The largest coordinate.
    """

    V: Real
    site: Ints
    F: Ints
    polygon: Ints
    corner: Ints
    solved: Ints
    solved_polygon: Ints
    vertex_of_site: Ints
    first_vertex: Ints
    first_virtual: Ints
    first_face: Ints
    first_solved: Ints
    area: Real
    unit: float

    def __getitem__(self, chart: int) -> ChartMesh:
        vertices = slice(self.first_vertex[chart], self.first_vertex[chart + 1])
        own = slice(self.first_vertex[chart], self.first_virtual[chart])
        faces = slice(self.first_face[chart], self.first_face[chart + 1])
        solved = slice(self.first_solved[chart], self.first_solved[chart + 1])
        return ChartMesh(
            V=self.V[vertices],
            vertices=self.vertex_of_site[self.site[own]],
            F=self.F[faces],
            polygon=self.polygon[faces],
            corner=self.corner[faces],
            solved=self.solved[solved],
            solved_polygon=self.solved_polygon[solved],
        )

    @cached_property
    def chart_of_face(self) -> Ints:
        """The chart of each row of F."""
        return np.repeat(np.arange(len(self.area)), np.diff(self.first_face))

    @cached_property
    def chart_of_vertex(self) -> Ints:
        """The chart of each vertex; those of no chart, at the end, are left out."""
        return np.repeat(np.arange(len(self.area)), np.diff(self.first_vertex))

    def used_vertices(self) -> int:
        """How many of the caller's vertices the charts have."""
        site = self.site[: self.first_vertex[-1]]
        used = np.zeros(int(self.vertex_of_site.max(initial=-1)) + 1, dtype=bool)
        used[self.vertex_of_site[site[site < len(self.vertex_of_site)]]] = True
        return int(used.sum())

    def with_any(self, vertices: Ints) -> NDArray[np.bool_]:
        """Charts (count,) that have one of some of the caller's vertices."""
        site = self.site[: self.first_vertex[-1]]
        own = np.flatnonzero(site < len(self.vertex_of_site))
        out = np.zeros(len(self.area), dtype=bool)
        out[self.chart_of_vertex[own[np.isin(self.vertex_of_site[site[own]], vertices)]]] = True
        return out

    @cached_property
    def F_of_all(self) -> Ints:
        """F with the vertices numbered through all charts."""
        return self.F + self.first_vertex[self.chart_of_face][:, None]

    def weights(self) -> Ints:
        """Number of triangles to solve on in each chart, (count,)."""
        return np.diff(self.first_solved)


def chart_meshes(mesh: PolygonMesh, surface: CutSurface, count: int) -> ChartMeshes:
    """Triangulate the polygons of `mesh` over the sites of the cut surface, and number each chart from 0.

    A polygon that fills a hole becomes a star of triangles around a virtual vertex. So does one of the caller's
    polygons where a diagonal would fall on another edge between the same two vertices (two quads that meet in
    three vertices); its own triangles still serve for measuring.
    """
    F, polygon, corner_of = triangulate(mesh)
    sites = len(surface.vertex_of_site)
    T = surface.site[corner_of]
    starred = _starred(T, corner_of, surface, sites)
    kept = ~starred[polygon]
    star, star_polygon, centres = _stars(surface, starred, sites)
    V = np.concatenate((surface.V[surface.vertex_of_site], centres))

    solved = np.concatenate((T[kept], star)) if len(star) else T
    solved_polygon = np.concatenate((polygon[kept], star_polygon)) if len(star) else polygon
    chart_of_site = np.full(len(V), count, dtype=np.int64)
    chart_of_site[T] = surface.chart[polygon][:, None]
    chart_of_site[star] = surface.chart[star_polygon][:, None]
    order, first_vertex = _grouped(chart_of_site, count)
    number = np.empty(len(V), dtype=np.int64)
    number[order] = np.arange(len(V))
    number -= np.append(first_vertex, 0)[chart_of_site]
    own = np.bincount(chart_of_site[:sites], minlength=count)[:count]

    by_chart, first_face = _grouped(surface.chart[polygon], count)
    by_chart_solved, first_solved = _grouped(surface.chart[solved_polygon], count)
    scale = max(float(np.abs(surface.V).max()), float(np.finfo(float).tiny))
    double = triangle_geometry(surface.V / scale, np.ascontiguousarray(F.T.astype(np.int32))).double_area
    return ChartMeshes(
        V=V[order],
        site=order,
        F=number[T[by_chart]],
        polygon=polygon[by_chart],
        corner=corner_of[by_chart],
        solved=number[solved[by_chart_solved]],
        solved_polygon=solved_polygon[by_chart_solved],
        vertex_of_site=surface.vertex_of_site,
        first_vertex=first_vertex,
        first_virtual=first_vertex[:-1] + own,
        first_face=first_face,
        first_solved=first_solved,
        area=0.5 * np.bincount(surface.chart[polygon], double, minlength=count).astype(np.float64),
        unit=scale,
    )


def _grouped(chart: Ints, count: int) -> tuple[Ints, Ints]:
    """An order chart after chart (what is in none goes last), and where each chart begins, (count + 1,)."""
    first = np.concatenate((np.zeros(1, dtype=np.int64), np.cumsum(np.bincount(chart, minlength=count)[:count])))
    if count == 1 and first[1] == len(chart):
        return np.arange(len(chart)), first
    return np.argsort(chart, kind="stable"), first


def _starred(T: Ints, corner_of: Ints, surface: CutSurface, sites: int) -> NDArray[np.bool_]:
    """Polygons to be mapped as stars, (p,)."""
    starred = np.zeros(len(surface.chart), dtype=bool)
    starred[surface.real :] = True
    following = corner_of[:, [1, 2, 0]]
    is_diagonal = surface.follow[corner_of] != following
    if not is_diagonal.any():
        return starred
    tail, head = T[is_diagonal], T[:, [1, 2, 0]][is_diagonal]
    owner = surface.polygon[corner_of[is_diagonal]]
    one = tail < head  # each diagonal has two half-edges, one of them this way
    diagonal, owner = edge_keys(tail[one], head[one], sites), owner[one]
    own_sides = np.flatnonzero(surface.polygon < surface.real)
    side = np.sort(edge_keys(surface.site[own_sides], surface.site[surface.follow[own_sides]], sites))
    on_side = side[np.minimum(np.searchsorted(side, diagonal), len(side) - 1)] == diagonal
    order = np.argsort(diagonal)
    again = np.zeros(len(order), dtype=bool)
    again[order[1:]] = diagonal[order[1:]] == diagonal[order[:-1]]
    again[order[:-1]] |= diagonal[order[1:]] == diagonal[order[:-1]]
    starred[owner[on_side | again]] = True
    return starred


def _stars(surface: CutSurface, starred: NDArray[np.bool_], sites: int) -> tuple[Ints, Ints, Real]:
    """Triangles (k, 3), their polygons (k,), and the centres (c, 3), numbered from `sites` on."""
    if not starred.any():
        return np.empty((0, 3), dtype=np.int64), np.empty(0, dtype=np.int64), np.empty((0, 3))
    corner = np.flatnonzero(starred[surface.polygon])
    polygon = surface.polygon[corner]
    number = np.cumsum(starred) - 1
    star = np.column_stack((surface.site[corner], surface.site[surface.follow[corner]], sites + number[polygon]))
    size = np.bincount(number[polygon]).astype(np.float64)
    centres = [np.bincount(number[polygon], x) / size for x in surface.V[surface.vertex[corner]].T]
    return star, polygon, np.column_stack(centres)
