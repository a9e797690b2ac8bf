"""Whether the surface is an oriented disk: the checks of `Surface`, in their order and with their indices."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..mesh import refusals
from ..mesh.fans import corner_links, pinched_vertices
from ..mesh.halfedges import joined_pairs
from ..mesh.loops import traced_loops
from ..mesh.orientation import disagreeing_pairs
from .components import joined_components, local_representatives
from .part import Part
from .shares import Shares, fetched

__all__ = ["Boundary", "required_disk"]

Ints = NDArray[np.int64]


class Boundary(NamedTuple):
    """The boundary loop, held by every rank: its vertices (nb,), and their scaled positions (nb, 3)."""

    loop: Ints
    points: NDArray[np.float64]


def required_disk(part: Part) -> Boundary:
    """The boundary of a surface that is a disk.

    Raises
    ------
    MeshError
        On all ranks, or the subclass that says what is wrong.
    """
    _check_edges(part)
    _check_orientation(part)
    loops, points = _loops(part)
    told, _, _ = part.told_edges()
    ranks = part.ranks
    euler = part.vertices.count - int(ranks.total(np.array([np.count_nonzero(told)]))[0]) + part.faces.count
    pieces = 1
    if len(loops) + euler != 2 or len(loops) > 1 or not _is_face_connected(part):
        _check_fans(part)
        pieces = _pieces(part)
    if pieces > 1:
        raise refusals.several_pieces(pieces)
    genus = (2 * pieces - len(loops) - euler) // 2
    if not loops:
        raise refusals.closed(genus)
    if len(loops) > 1:
        raise refusals.several_loops(loops, [_length(point) for point in points], genus)
    if genus:
        raise refusals.handles(genus)
    if _on_one_line(part):
        raise refusals.no_extent(part.faces.count)
    return Boundary(loops[0], points[0])


def _check_edges(part: Part) -> None:
    """See `manifold.check_edges`."""
    ranks, edges, m = part.ranks, part.edges, part.corners.shape[1]
    told, lo, hi = part.told_edges()
    crowded = told & (edges.count > 2)
    across = np.where(edges.twin >= 0, edges.twin % max(m, 1), -1 - np.arange(3 * m, dtype=np.int32)).reshape(3, m)
    folded = (across[0] == across[1]) | (across[1] == across[2]) | (across[2] == across[0])
    any_crowded = ranks.any(bool(crowded.any()))
    if any_crowded or ranks.any(bool(folded.any())):
        three = np.sort(part.names(part.corners), axis=0)
        here = part.vertices.owned(three[0])  # both of two that are alike are known there
        _, index, count = np.unique(three[:, here], axis=1, return_inverse=True, return_counts=True)
        twice = ranks.indices(part.face[here][count[index.reshape(-1)] > 1])
        if len(twice):
            raise refusals.duplicates(twice)
    if any_crowded:
        pairs = ranks.joined(np.column_stack((lo[crowded], hi[crowded])))
        pairs = pairs[np.lexsort(pairs.T[::-1])]
        faces = part.face[crowded[edges.edge].reshape(3, m).any(axis=0)]
        raise refusals.crowded_edges(pairs[:, 0], pairs[:, 1], ranks.indices(faces))


def _check_orientation(part: Part) -> None:
    """See `manifold.check_orientation` and `orientation.face_signs`."""
    ranks, m, M = part.ranks, part.corners.shape[1], part.faces.count
    vertex = part.corners.reshape(-1)
    if not ranks.any(bool(len(disagreeing_pairs(vertex, part.edges.twin)))):
        return
    one, other = joined_pairs(part.edges.twin)
    f, g = part.face[one % m], part.face[other % m]
    crossed = M * (vertex[one] == vertex[other]).astype(np.int64)
    cover = Shares.even(ranks, 2 * M)
    label = joined_components(ranks, cover, np.concatenate((f, f + M)), np.concatenate((g + crossed, g + M - crossed)))
    mine = np.arange(part.faces.first, part.faces.last)
    plus, minus = fetched(ranks, cover, label, mine), fetched(ranks, cover, label, mine + M)
    piece = np.minimum(plus, minus)
    lead = plus == piece
    sums = np.zeros((cover.last - cover.first, 2), dtype=np.int64)
    at, counts = ranks.exchanged(
        cover.owner(piece), piece, np.column_stack((lead, np.ones_like(lead))).astype(np.int64)
    )
    np.add.at(sums, at - cover.first, counts)
    leading = fetched(ranks, cover, sums, piece)
    larger = 2 * leading[:, 0] >= leading[:, 1]
    folded = ranks.indices(mine[plus == minus])
    if len(folded):
        raise refusals.one_sided(folded)
    raise refusals.disagreeing(ranks.indices(mine[lead != larger]))


def _loops(part: Part) -> tuple[list[Ints], list[NDArray[np.float64]]]:
    """All boundary loops and their positions, on every rank; they have the root of the number of vertices."""
    ranks, m = part.ranks, part.corners.shape[1]
    tails, heads = part.corners.reshape(-1), part.corners[[1, 2, 0]].reshape(-1)
    side = np.flatnonzero((part.edges.twin == -1) & (tails < part.own))
    leaving = np.bincount(tails[side], minlength=part.own)
    bad = ranks.indices(part.vertices.first + np.flatnonzero(leaving > 1))
    if len(bad):
        raise refusals.pinched_boundary(bad)
    reading = part.face[side % max(m, 1)] * 3 + side // max(m, 1)
    rows = ranks.joined(np.column_stack((reading, part.names(tails[side]), part.names(heads[side]))))
    points = ranks.joined(part.V[tails[side]])
    if not len(rows):
        return [], []
    order = np.argsort(rows[:, 0])
    rows, points = rows[order], points[order]
    vertices, starts = traced_loops(rows[:, 1], rows[:, 2])
    by_name = np.argsort(rows[:, 1])
    points = points[by_name[np.searchsorted(rows[:, 1], vertices, sorter=by_name)]]
    return np.split(vertices, starts[1:]), np.split(points, starts[1:])


def _is_face_connected(part: Part) -> bool:
    """Whether every face can be reached from every other across edges."""
    m, ranks = part.corners.shape[1], part.ranks
    one, other = joined_pairs(part.edges.twin)
    lowest = local_representatives(m, one % max(m, 1), other % max(m, 1), part.face)
    shared = (part.corners >= part.own).any(axis=0)  # some other rank knows the face, too
    label = joined_components(ranks, part.faces, lowest[shared], part.face[shared])
    roots = fetched(ranks, part.faces, label, np.unique(lowest))
    return len(ranks.indices(np.unique(roots))) == 1


def _pieces(part: Part) -> int:
    """How many pieces there are, whose faces hang together at vertices."""
    ranks, names = part.ranks, part.names(np.arange(part.size))
    rows, columns = part.corners[:2].reshape(-1), part.corners[1:].reshape(-1)
    lowest = local_representatives(part.size, rows, columns, names)
    shared = np.concatenate((part.ghosts.lent, np.arange(part.own, part.size)))
    label = joined_components(ranks, part.vertices, lowest[shared], names[shared])
    roots = np.unique(fetched(ranks, part.vertices, label, np.unique(lowest)))
    (found,) = ranks.exchanged(part.vertices.owner(roots), roots)
    return int(ranks.total(np.array([len(np.unique(found))]))[0])


def _check_fans(part: Part) -> None:
    """See `manifold.check_fans`."""
    m = part.corners.shape[1]
    vertex = part.corners.reshape(-1).astype(np.int64)
    following = (np.arange(3 * m) + m) % max(3 * m, 1)
    bad = pinched_vertices(vertex, *corner_links(vertex, following, *joined_pairs(part.edges.twin)), part.size)
    bad = part.ranks.indices(part.vertices.first + bad[bad < part.own])
    if len(bad):
        raise refusals.pinched(bad)


def _on_one_line(part: Part) -> bool:
    """See `arrays.on_one_line`: the same with the farthest vertex found together."""
    ranks, own = part.ranks, part.V[: part.own]
    first = next(point for point in ranks.each(own[0] if len(own) else None) if point is not None)
    from_first = own - first
    reach = np.abs(from_first).max(axis=1, initial=0.0)
    at = int(np.argmax(reach)) if len(own) else 0
    _, farthest = max(ranks.each((float(reach[at]), from_first[at].tolist()) if len(own) else (-1.0, [0.0] * 3)))
    size = np.array([ranks.most(float(np.abs(column).max(initial=0.0))) for column in own.T])
    wide = False
    for i, j in ((0, 1), (1, 2), (2, 0)):
        across = from_first[:, i] * farthest[j] - from_first[:, j] * farthest[i]
        rounding = 8.0 * np.finfo(np.float64).eps * (size[i] * abs(farthest[j]) + size[j] * abs(farthest[i]))
        wide = wide or bool(np.abs(across).max(initial=0.0) > rounding)
    return not ranks.any(wide)


def _length(points: NDArray[np.float64]) -> float:
    return float(np.linalg.norm(points - np.roll(points, -1, axis=0), axis=1).sum())
