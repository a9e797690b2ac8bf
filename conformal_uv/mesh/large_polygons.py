"""Large polygons to triangles in O(n log n): clean ears cut side by side, what is left by mapbox-earcut.

Ear clipping one ear at a time, earcut's too, takes the square of the number of corners where many of them lie on one
line or circle. Corners on straight sides are left out first and put back at the end, so that every side of the polygon
is a side of a triangle.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

__all__ = ["cut_large_polygon"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]

FEW = 128  # corners that are left to earcut
LEAST_PART = 0.002  # of the corners that a round must cut, or the rest is left to earcut
NEIGHBOURS = 16  # reflex corners looked at around an ear; with more in reach it waits for another round


def cut_large_polygon(P: Real) -> Ints | None:
    """Triangles (n - 2, 3) of a plane polygon (n, 2), wound anticlockwise, as corner numbers.

    None where no triangulation is found: the polygon crosses itself, or mapbox-earcut is needed and not installed.
    """
    n = len(P)
    turn = _turns(P, np.arange(n))
    ring = np.flatnonzero(turn != 0.0)
    if len(ring) < 3:
        return None
    used, cut = ring, []
    while len(ring) > FEW:
        tips = _clean_ears(P, ring)
        if len(tips) < LEAST_PART * len(ring):
            break
        cut.append(np.column_stack((ring[tips - 1], ring[tips], ring[(tips + 1) % len(ring)])))
        ring = np.delete(ring, tips)
    rest = _earcut(P[ring]) if len(ring) > 3 else np.arange(3)[None]
    if rest is None:
        return None
    triangles = np.concatenate([*cut, ring[rest]])
    used = np.unique(triangles)
    for _ in range(3):  # a triangle takes up the corners left out on one of its sides at a time
        if len(triangles) == n - 2:
            break
        triangles = _with_corners_on_sides(triangles, used, n)
    return triangles if _is_triangulation(triangles, n) else None


def _turns(P: Real, ring: Ints) -> Real:
    """Twice the area of the triangle at every corner of the ring: positive where it is convex."""
    a, b, c = P[np.roll(ring, 1)], P[ring], P[np.roll(ring, -1)]
    return np.asarray((b[:, 0] - a[:, 0]) * (c[:, 1] - b[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - b[:, 0]))


def _clean_ears(P: Real, ring: Ints) -> Ints:
    """Convex corners, no two of them neighbours, whose triangles hold no other corner; places in the ring."""
    turn = _turns(P, ring)
    a, b, c = P[np.roll(ring, 1)], P[ring], P[np.roll(ring, -1)]
    reach = np.where(turn > 0.0, np.linalg.norm(c - a, axis=1), np.inf)
    order = np.empty(len(ring), dtype=np.int64)  # short diagonals first; ties are spread, so that half may be cut
    order[np.lexsort((np.arange(len(ring)) % 2, reach))] = np.arange(len(ring))
    first = (order < np.roll(order, 1)) & (order < np.roll(order, -1)) & (turn > 0.0)
    tips = np.flatnonzero(first)
    reflex = np.flatnonzero(turn <= 0.0)
    if not len(reflex) or not len(tips):
        return tips
    T = np.stack((a[tips], b[tips], c[tips]), axis=1)
    middle = T.mean(axis=1)
    radius = np.linalg.norm(T - middle[:, None], axis=2).max(axis=1) * (1.0 + 1e-9)
    many = min(NEIGHBOURS, len(reflex))
    _, near = cKDTree(P[ring[reflex]]).query(middle, k=many, distance_upper_bound=float(radius.max()))
    near = np.asarray(near).reshape(len(tips), many)
    there = near < len(reflex)
    place = reflex[np.where(there, near, 0)]
    Q = P[ring[place]]
    within = there & (np.linalg.norm(Q - middle[:, None], axis=2) <= radius[:, None])
    crowded = within.all(axis=1) & (many == NEIGHBOURS)
    own = (place == tips[:, None] - 1) | (place == (tips[:, None] + 1) % len(ring)) | (place == tips[:, None])
    own |= (tips[:, None] == 0) & (place == len(ring) - 1)
    inside = np.ones(place.shape, dtype=bool)
    for k in range(3):
        side, to = T[:, (k + 1) % 3] - T[:, k], Q - T[:, k, None]
        inside &= side[:, None, 0] * to[..., 1] - side[:, None, 1] * to[..., 0] >= 0.0
    return tips[~(within & ~own & inside).any(axis=1) & ~crowded]


def _earcut(P: Real) -> Ints | None:
    """Triangles of a polygon by mapbox-earcut, anticlockwise; corners on straight sides may be left out."""
    try:
        from mapbox_earcut import triangulate_float64
    except ImportError:
        return None
    found = triangulate_float64(np.ascontiguousarray(P), np.array([len(P)], dtype=np.uint32))
    triangles = np.asarray(found, dtype=np.int64).reshape(-1, 3)
    if not len(triangles):
        return None
    a, b, c = (P[corner] for corner in triangles.T)
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    return triangles if area.sum() >= 0.0 else triangles[:, ::-1]


def _with_corners_on_sides(triangles: Ints, used: Ints, n: int) -> Ints:
    """Triangles with a side between two `used` corners that follow each other, cut into fans over the corners between
    those two."""
    between = (np.roll(used, -1) - used) % n - 1  # corners left out after each
    place = np.full(n, -1, dtype=np.int64)
    place[used] = np.arange(len(used))
    tail, head = place[triangles], place[np.roll(triangles, -1, axis=1)]
    missing = np.where((tail >= 0) & (head >= 0) & ((tail + 1) % len(used) == head), between[tail], 0)
    side = np.argmax(missing > 0, axis=1)
    count = missing[np.arange(len(triangles)), side]
    rows = np.repeat(np.arange(len(triangles)), count + 1)
    step = np.arange(len(rows)) - np.repeat(np.cumsum(count + 1) - count - 1, count + 1)
    first = triangles[rows, side[rows]]
    end = np.where(count[rows] == 0, triangles[rows, (side[rows] + 1) % 3], (first + step + 1) % n)
    return np.column_stack(((first + step) % n, end, triangles[rows, (side[rows] + 2) % 3]))


def _is_triangulation(triangles: Ints, n: int) -> bool:
    """Whether there are n - 2 triangles that have each side of the polygon once and each diagonal both ways."""
    if len(triangles) != n - 2:
        return False
    tail, head = triangles.reshape(-1), np.roll(triangles, -1, axis=1).reshape(-1)
    sides = (tail + 1) % n == head
    if not np.array_equal(np.sort(tail[sides]), np.arange(n)):
        return False
    there, back = np.sort(tail[~sides] * n + head[~sides]), np.sort(head[~sides] * n + tail[~sides])
    return bool((there == back).all() and (np.diff(there) > 0).all())
