"""The selected polygons of a mesh: how their sides are joined, and the charts they hang together in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..mesh.halfedges import joined_pairs
from ..mesh.polygon_sides import PolygonSides, edge_keys, polygon_sides
from ..mesh.polygons import PolygonMesh
from .arguments import check_seams

__all__ = ["SelectedPart", "crowded_pairs", "linked_charts", "mesh_of", "selected_part"]

Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class SelectedPart:
    """The selected polygons over the caller's vertices, before anything is cut.

    Every side still knows its edge, and so the seams, and the edges of three or more sides; a CutSurface knows only
    which side is joined to which, has vertices of its own, and may have polygons that fill holes.

    Attributes
    ----------
    mesh : PolygonMesh
    sides : PolygonSides
        As the polygons meet, whatever was marked as a seam.
    seam : (e,) bool
        Edges marked as seams.
    twin : (k,) int64
        The side joined to each side; -1 at seams and borders and where an edge has three or more sides.
    """

    mesh: PolygonMesh
    sides: PolygonSides
    seam: NDArray[np.bool_]
    twin: Ints

    @property
    def joined(self) -> tuple[Ints, Ints]:
        """Pairs of joined sides, each pair once."""
        return joined_pairs(self.twin)


def mesh_of(mesh: PolygonMesh, polygons: Ints) -> tuple[PolygonMesh, Ints]:
    """The mesh of some of the polygons, and the corner of the whole mesh that each of its corners was."""
    if len(polygons) == len(mesh.sizes):
        return mesh, np.arange(len(mesh.corners))
    sizes = mesh.sizes[polygons]
    starts = np.concatenate((np.zeros(1, dtype=np.int64), np.cumsum(sizes)))
    corner = np.arange(starts[-1]) + np.repeat(mesh.starts[polygons] - starts[:-1], sizes)
    return PolygonMesh(mesh.V, mesh.corners[corner], starts), corner


def selected_part(mesh: PolygonMesh, whole: PolygonMesh, seams: Ints) -> SelectedPart:
    """Join the sides of `mesh`, the selected polygons of `whole`, but for the seams (s, 2).

    Raises
    ------
    OptionError
        A seam that is not an edge of the whole mesh.
    """
    sides = polygon_sides(mesh)
    seam = np.zeros(len(sides.key), dtype=bool)
    if len(seams):
        key = edge_keys(seams[:, 0], seams[:, 1], len(mesh.V))
        place = np.minimum(np.searchsorted(sides.key, key), len(sides.key) - 1)
        found = (sides.key[place] == key) & (seams >= 0).all(axis=1) & (seams < len(mesh.V)).all(axis=1)
        seam[place[found]] = True
        if not found.all():
            check_seams(seams[~found], whole)
    twin = np.where(sides.twin >= 0, sides.twin, -1)
    if len(seams):
        twin[seam[sides.edge]] = -1
    return SelectedPart(mesh, sides, seam, twin)


def linked_charts(part: SelectedPart, *, across_crowded: bool) -> tuple[int, Ints]:
    """Number of charts, and the chart of each polygon; charts in the order of their first polygons.

    Parameters
    ----------
    across_crowded : bool
        Whether edges of three and more polygons hold a chart together (unless they are seams).
    """
    polygon, p = part.sides.polygon, len(part.mesh.sizes)
    one, other = part.joined
    f, g = polygon[one], polygon[other]
    if across_crowded:
        left, right = crowded_pairs(part, ~part.seam)
        f, g = np.concatenate((f, polygon[left])), np.concatenate((g, polygon[right]))
    graph = coo_array((np.ones(len(f), dtype=np.int8), (f, g)), shape=(p, p))
    count, label = connected_components(graph, directed=False)
    first = np.empty(count, dtype=np.int64)
    first[label[::-1]] = np.arange(p - 1, -1, -1)
    rank = np.empty(count, dtype=np.int64)
    rank[np.argsort(first)] = np.arange(count)
    return count, rank[label]


def crowded_pairs(part: SelectedPart, edges: NDArray[np.bool_]) -> tuple[Ints, Ints]:
    """Sides that follow each other on an edge of three or more, of the `edges` (e,) bool."""
    edge = part.sides.edge
    side = np.flatnonzero((part.sides.twin == -2) & edges[edge])
    side = side[np.argsort(edge[side], kind="stable")]
    same = edge[side[1:]] == edge[side[:-1]]
    return side[:-1][same], side[1:][same]
