"""Many small triangle meshes side by side: those that are disks beyond doubt."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..mesh.arrays import scaled_each
from ..mesh.geometry import TriangleGeometry, triangle_geometry
from ..mesh.halfedges import HalfEdges, half_edges
from ..mesh.loops import joined_loops

__all__ = ["Disks", "neighbours", "places", "sound_disks"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]
Bools = NDArray[np.bool_]

LEAST_EXTENT = 1e-4  # of a mesh, over its largest coordinate; a smaller one loses digits to where it lies
ROOM = 1e-9  # by which two edges of a face together are longer than the third one, in the same unit


@dataclass(frozen=True, eq=False)
class Disks:
    """Disks one after another in shared arrays, c of them.

    Attributes
    ----------
    number : (c,) int64
        What the caller calls each.
    V : (n, 3) float64
        Each disk's divided by a power of two, so that its largest coordinate lies in [1/2, 1).
    unit : (c,) float64
        That power.
    corners : (3, m) int32
    edges : HalfEdges
    geometry : TriangleGeometry
    loop : (nb,) int64
        The boundary of each as `mesh.loops.boundary_loops` has it.
    first_vertex, first_face, first_boundary : (c + 1,) int64
        Where each begins.
    of_vertex, of_face, of_boundary : int64
        The disk of each vertex, face and boundary vertex, 0 .. c - 1.
    """

    number: Ints
    V: Real
    unit: Real
    corners: NDArray[np.int32]
    edges: HalfEdges
    geometry: TriangleGeometry
    loop: Ints
    first_vertex: Ints
    first_face: Ints
    first_boundary: Ints
    of_vertex: Ints
    of_face: Ints
    of_boundary: Ints

    def __len__(self) -> int:
        return len(self.number)

    @property
    def n(self) -> int:
        """Vertices of all together."""
        return len(self.V)


def places(first: Ints, chosen: Ints) -> Ints:
    """``first[k] .. first[k + 1] - 1`` of every chosen k, one after the other."""
    count = first[chosen + 1] - first[chosen]
    return np.arange(int(count.sum())) + np.repeat(first[chosen] - (np.cumsum(count) - count), count)


def neighbours(first: Ints) -> tuple[Ints, Ints]:
    """The places after and before each place, around loops that begin at ``first[k]``, none of them empty."""
    ahead = np.arange(1, int(first[-1]) + 1)
    ahead[first[1:] - 1] = first[:-1]
    behind = np.arange(-1, int(first[-1]) - 1)
    behind[first[:-1]] = first[1:] - 1
    return ahead, behind


def sound_disks(
    V: Real, F: Ints, first_vertex: Ints, first_face: Ints, chosen: Ints, most_boundary: int
) -> Disks | None:
    """Those of the chosen meshes that are disks, and on which rounding decides nothing; None where there are none.

    Parameters
    ----------
    V : (n, 3) float64
        Of all meshes, one after the other, finite.
    F : (m, 3) int64
        Numbered in each mesh from 0; each mesh hangs together across edges.
    first_vertex, first_face : (count + 1,) int64
        Where each mesh begins.
    chosen : (k,) int64
        Ascending.
    most_boundary : int
        Boundary vertices of each that is taken.
    """
    chosen = chosen[(np.diff(first_face)[chosen] > 0) & (np.diff(first_vertex)[chosen] > 2)]
    while len(chosen):
        vertices, starts = _joined(first_vertex, chosen)
        faces, face_starts = _joined(first_face, chosen)
        of_vertex, of_face = _owners(starts), _owners(face_starts)
        corners = np.ascontiguousarray((F[faces] + starts[of_face][:, None]).T.astype(np.int32))
        edges = half_edges(corners, len(vertices))
        good = _are_manifolds(corners, edges, of_vertex, of_face, len(chosen))
        if good.all():
            points, unit = scaled_each(V[vertices], of_vertex, len(chosen))
            geometry = triangle_geometry(points, corners)
            good = _have_room(points, geometry, starts, of_face)
        if good.all():
            loop, begins = joined_loops(corners, edges.twin)
            loops = of_vertex[loop]
            good = np.bincount(loops[begins], minlength=len(chosen)) == 1
            good &= np.bincount(loops, minlength=len(chosen)) <= most_boundary
        if good.all():
            boundary_starts = np.append(begins, len(loop))
            return Disks(
                number=chosen,
                V=points,
                unit=unit,
                corners=corners,
                edges=edges,
                geometry=geometry,
                loop=loop,
                first_vertex=starts,
                first_face=face_starts,
                first_boundary=boundary_starts,
                of_vertex=of_vertex,
                of_face=of_face,
                of_boundary=loops,
            )
        chosen = chosen[good]
    return None


def _joined(first: Ints, chosen: Ints) -> tuple[Ints, Ints]:
    """What the chosen take of an array, and where each begins in that."""
    count = first[chosen + 1] - first[chosen]
    return places(first, chosen), np.concatenate((np.zeros(1, dtype=np.int64), np.cumsum(count)))


def _owners(starts: Ints) -> Ints:
    return np.repeat(np.arange(len(starts) - 1), np.diff(starts))


def _are_manifolds(corners: NDArray[np.int32], edges: HalfEdges, of_vertex: Ints, of_face: Ints, count: int) -> Bools:
    """Whether each mesh is wound one way, its edges have one or two faces, its boundary passes no vertex twice, its
    vertices are all used, and its Euler number is 1."""
    m, n = corners.shape[1], len(of_vertex)
    tail, head = corners.reshape(-1), corners[[1, 2, 0]].reshape(-1)
    twin = edges.twin
    wrong = (twin == -2) | (tail == head)
    paired = np.flatnonzero(twin >= 0)
    wrong[paired] |= tail[twin[paired]] != head[paired]
    bad = np.zeros(count, dtype=bool)
    bad[of_face[np.flatnonzero(wrong) % m]] = True
    leaving = np.bincount(tail[twin == -1], minlength=n)
    bad[of_vertex[(leaving > 1) | (np.bincount(tail, minlength=n) == 0)]] = True
    euler = np.bincount(of_vertex, minlength=count) + np.bincount(of_face, minlength=count)
    euler -= np.bincount(of_vertex[edges.lo], minlength=count)
    return ~bad & (euler == 1)


def _have_room(V: Real, geometry: TriangleGeometry, starts: Ints, of_face: Ints) -> Bools:
    """Whether each mesh is large enough and has no needles or faces without area."""
    extent = (np.maximum.reduceat(V, starts[:-1]) - np.minimum.reduceat(V, starts[:-1])).max(axis=1)
    lengths = np.sqrt(np.maximum(geometry.squared_lengths, 0.0))
    spare = lengths.sum(axis=0) - 2.0 * lengths.max(axis=0)
    bad = extent < LEAST_EXTENT
    bad[of_face[spare <= ROOM]] = True
    return ~bad
