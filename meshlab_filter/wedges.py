"""Which corner of which polygon each corner of MeshLab's triangles is.

MeshLab keeps a polygon as triangles that share hidden edges, and tells the polygons only as a list.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

__all__ = ["Wedges", "triangle_wedges", "wedges_of_polygons"]

Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Wedges:
    """Polygons, and where each wedge (corner of a triangle, three a face) is among their corners.

    Attributes
    ----------
    corners : (k,) int64
        Vertices of the polygons' corners.
    starts : (p + 1,) int64
        Where each polygon's corners begin.
    corner : (3m,) int64
        The polygon corner of each wedge.
    polygon : (m,) int64
        The polygon of each face.
    """

    corners: Ints
    starts: Ints
    corner: Ints
    polygon: Ints


def triangle_wedges(F: Ints) -> Wedges:
    """Every face is a polygon of its own."""
    corners = F.reshape(-1)
    return Wedges(corners, 3 * np.arange(len(F) + 1), np.arange(len(corners)), np.arange(len(F)))


def wedges_of_polygons(F: Ints, polygons: list[NDArray[np.uint32]], n: int) -> Wedges | None:
    """The wedges of faces F (m, 3) over n vertices in `polygons`.

    None where the list does not tell which polygon a face belongs to: sides that stand twice, holes in polygons,
    vertices that stand twice in one.
    """
    sizes = np.fromiter(map(len, polygons), dtype=np.int64, count=len(polygons))
    starts = np.concatenate((np.zeros(1, dtype=np.int64), np.cumsum(sizes)))
    corners = np.concatenate(polygons).astype(np.int64)
    owner = np.repeat(np.arange(len(sizes)), sizes)
    following = np.arange(1, len(corners) + 1)
    following[starts[1:] - 1] = starts[:-1]
    polygon = _polygon_of_face(F, corners * n + corners[following], owner, n)
    if polygon is None or (np.bincount(polygon, minlength=len(sizes)) != sizes - 2).any():
        return None
    keys, wanted = owner * n + corners, np.repeat(polygon, 3) * n + F.reshape(-1)
    order = np.argsort(keys, kind="stable")
    place = np.minimum(np.searchsorted(keys[order], wanted), len(keys) - 1)
    if (keys[order][place] != wanted).any() or (np.diff(keys[order]) == 0).any():
        return None
    return Wedges(corners, starts, order[place], polygon)


def _polygon_of_face(F: Ints, sides: Ints, owner: Ints, n: int) -> Ints | None:
    """The polygon of each face, (m,): faces joined across hidden edges share it."""
    order = np.argsort(sides, kind="stable")
    sides, owner = sides[order], owner[order]
    tail, head = F.reshape(-1), F[:, [1, 2, 0]].reshape(-1)
    own = tail * n + head
    if (np.diff(sides) == 0).any() or len(np.unique(own)) != len(own):
        return None
    place = np.minimum(np.searchsorted(sides, own), len(sides) - 1)
    shown = sides[place] == own
    hidden = np.flatnonzero(~shown)
    across, turned = own[hidden], head[hidden] * n + tail[hidden]
    sorting = np.argsort(across)
    partner = np.minimum(np.searchsorted(across[sorting], turned), max(len(hidden) - 1, 0))
    if len(hidden) and (across[sorting][partner] != turned).any():
        return None
    pairs = (hidden // 3, hidden[sorting][partner] // 3) if len(hidden) else (hidden, hidden)
    count, piece = connected_components(coo_array((np.ones(len(hidden)), pairs), shape=(len(F), len(F))))
    of_piece = np.full(count, -1, dtype=np.int64)
    of_piece[piece[np.flatnonzero(shown) // 3]] = owner[place[shown]]
    polygon = of_piece[piece]
    face = np.flatnonzero(shown) // 3
    return polygon if (polygon >= 0).all() and (polygon[face] == owner[place[shown]]).all() else None
