"""Polygons to triangles: the better diagonal of a quad, ear clipping for anything larger.

Ear clipping after Meisters (1975), run side by side on all polygons of one size.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import MeshError, listed
from .large_polygons import cut_large_polygon
from .polygons import PolygonMesh

__all__ = ["triangulate"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

FLAT = 1e-9
"""A triangle below this part of its polygon's area is flat: a corner that lies on a straight side."""

NEAR = 1e-7
"""A corner this close to an ear (part of the ear's height) makes it a poor one: it would leave a sliver."""

LARGE = 256
"""Corners, from which on a polygon goes through mapbox-earcut: clipping takes their number squared."""

MOST_CLIPPED = 4096
"""Corners of a polygon that is clipped where mapbox-earcut can not cut it."""

BATCH = 1 << 20
"""Polygon corners clipped side by side, to bound the memory."""


def triangulate(mesh: PolygonMesh) -> tuple[Ints, Ints, Ints]:
    """Cut every polygon into triangles over its own corners.

    Triangles pass through. A quad is cut along the shorter of the diagonals that leave both triangles facing
    the polygon's (Newell) normal. Larger polygons are clipped ear by ear in the plane of their normal, best
    ear (largest smallest angle) first; a simple polygon, convex or not, comes out as a true triangulation.
    A polygon that has none (self-crossing, without area) still gives size - 2 triangles. Polygons of 256 corners and
    more go through mapbox-earcut, which takes them in O(n log n).

    Returns
    -------
    F : (m, 3) int64
        Vertices of the triangles, polygon after polygon, in the polygon's winding.
    face_of_triangle : (m,) int64
        The polygon that each triangle was cut from.
    corner_of : (m, 3) int64
        Index into ``mesh.corners`` of each triangle corner: ``F == mesh.corners[corner_of]``.

    Raises
    ------
    MeshError
        A polygon has fewer than 3 corners.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> V = np.array([[0.0, 0, 0], [1, 0, 0], [1, 2, 0], [0, 1, 0]])
    >>> F, polygon, _ = cuv.triangulate(cuv.PolygonMesh(V, np.arange(4), np.array([0, 4])))
    >>> F.tolist(), polygon.tolist()
    ([[0, 1, 3], [1, 2, 3]], [0, 0])
    """
    sizes = mesh.sizes
    short = np.flatnonzero(sizes < 3)
    if len(short):
        raise MeshError(f"faces with fewer than 3 corners: {listed(short)}; remove them", short)
    if len(sizes) * 3 == len(mesh.corners):
        corner_of = np.arange(len(mesh.corners), dtype=np.int64).reshape(-1, 3)
        return mesh.corners[corner_of], np.arange(len(sizes), dtype=np.int64), corner_of
    face_of_triangle = np.repeat(np.arange(len(sizes), dtype=np.int64), sizes - 2)
    first = np.concatenate([np.zeros(1, np.int64), np.cumsum(sizes - 2)])
    corner_of = np.empty((first[-1], 3), np.int64)
    with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
        for size in np.unique(sizes).tolist():
            same = np.flatnonzero(sizes == size)
            for faces in np.array_split(same, 1 + len(same) * size // BATCH):
                corners = mesh.starts[faces, None] + np.arange(size)
                local = _cut(mesh.V[mesh.corners[corners]])
                rows = first[faces, None] + np.arange(size - 2)
                corner_of[rows] = corners[np.arange(len(faces))[:, None, None], local]
    return mesh.corners[corner_of], face_of_triangle, corner_of


def _cut(P: Floats) -> Ints:
    """Triangles (q, size - 2, 3) of polygons P (q, size, 3), as corner numbers 0 .. size - 1."""
    size = P.shape[1]
    if size == 3:
        return np.tile(np.arange(3), (len(P), 1, 1))
    if size == 4:
        return _cut_quads(P)
    flat = _flattened(P)
    if size < LARGE:
        return _clip_ears(flat)
    return np.stack([_cut_large(polygon) for polygon in flat])


def _cut_large(P: Floats) -> Ints:
    """Triangles (size - 2, 3) of one plane polygon (size, 2); a fan where it crosses itself and is too large."""
    triangles = cut_large_polygon(P)
    if triangles is not None:
        return triangles
    size = len(P)
    if size <= MOST_CLIPPED:
        return np.asarray(_clip_ears(P[None])[0])
    ring = np.arange(1, size - 1)
    return np.column_stack((np.zeros_like(ring), ring, ring + 1))


def _newell(P: Floats) -> Floats:
    """Area vectors (q, 3) of polygons P (q, size, 3): normal times twice the area."""
    E = P - P[:, :1]
    return np.asarray(np.cross(E[:, 1:-1], E[:, 2:]).sum(axis=1))


def _cut_quads(P: Floats) -> Ints:
    """Both ways to cut each quad are weighed by their smaller triangle, then by the diagonal's length."""
    splits = np.array([[[0, 1, 2], [0, 2, 3]], [[0, 1, 3], [1, 2, 3]]])
    N = _newell(P)
    area2 = np.einsum("qi,qi->q", N, N)
    T = P[:, splits]
    across = np.cross(T[..., 1, :] - T[..., 0, :], T[..., 2, :] - T[..., 0, :])
    smaller = np.einsum("qsti,qi->qst", across, N).min(axis=2)
    good = smaller > FLAT * area2[:, None]
    shorter = np.linalg.norm(P[:, 0] - P[:, 2], axis=1) <= np.linalg.norm(P[:, 1] - P[:, 3], axis=1)
    second = np.where(good.all(axis=1), ~shorter, smaller[:, 1] > smaller[:, 0])
    return splits[second.astype(np.int64)]


def _flattened(P: Floats) -> Floats:
    """Polygons P (q, size, 3) in the plane of their normals, (q, size, 2), of extent about 1."""
    N = _newell(P)
    length = np.linalg.norm(N, axis=1, keepdims=True)
    N = np.where(length > 0, N / length, [0.0, 0.0, 1.0])
    aside = np.eye(3)[np.abs(N).argmin(axis=1)]
    X = np.cross(aside, N)
    X /= np.linalg.norm(X, axis=1, keepdims=True)
    E = P - P[:, :1]
    E = E / np.maximum(np.abs(E).max(axis=(1, 2), keepdims=True), np.finfo(float).tiny)
    return np.stack([np.einsum("qsi,qi->qs", E, A) for A in (X, np.cross(N, X))], axis=2)


def _clip_ears(P: Floats) -> Ints:
    """Triangles (q, size - 2, 3) of plane polygons P (q, size, 2), cut off one ear a round."""
    q, size = P.shape[:2]
    rows = np.arange(q)
    ring = np.arange(size)
    before, after = np.tile(np.roll(ring, 1), (q, 1)), np.tile(np.roll(ring, -1), (q, 1))
    alive = np.ones((q, size), dtype=bool)
    quality = np.stack(
        [_ear_quality(P, alive, np.tile([(k - 1) % size, k, (k + 1) % size], (q, 1))) for k in range(size)], axis=1
    )
    triangles = np.empty((q, size - 2, 3), np.int64)
    for r in range(size - 2):
        tip = quality.argmax(axis=1)
        left, right = before[rows, tip], after[rows, tip]
        triangles[:, r] = np.stack([left, tip, right], axis=1)
        alive[rows, tip] = False
        quality[rows, tip] = -np.inf
        after[rows, left], before[rows, right] = right, left
        for k in (left, right):
            ear = np.stack([before[rows, k], k, after[rows, k]], axis=1)
            quality[rows, k] = _ear_quality(P, alive, ear)
    return triangles


def _ear_quality(P: Floats, alive: Bools, ear: Ints) -> Floats:
    """Sine of the smallest angle of the triangles at corners ``ear`` (q, 3) of P; +2 for a clean ear,
    -2 for one that covers another corner, -4 for one without area. Never NaN."""
    rows = np.arange(len(P))
    T = P[rows[:, None], ear]
    sides = np.roll(T, -1, axis=1) - T
    area = _cross(sides[:, 0], sides[:, 1])
    length = np.sqrt((sides**2).sum(axis=2))
    sine = area * length.min(axis=1) / np.maximum(length.prod(axis=1), np.finfo(float).tiny)
    # Height of each corner over each side, as a part of the ear's: inside where all three are >= 0.
    inside = np.min([_cross(sides[:, k, None], P - T[:, k, None]) for k in range(3)], axis=0)
    depth = inside / np.maximum(area, np.finfo(float).tiny)[:, None]
    same = np.any([(P == T[:, k, None]).all(axis=2) for k in range(3)], axis=0)
    depth = np.where(alive & ~same, depth, -np.inf).max(axis=1)
    tier = np.where(depth < -NEAR, 2, np.where(depth < 0, 0, -2))
    quality = np.where(area > FLAT * length.max(axis=1) ** 2, sine + tier, -4.0)
    quality = np.where((quality == -4.0) & (area > 0) & (depth < 0), sine, quality)
    return np.nan_to_num(np.asarray(quality, dtype=np.float64), nan=-4.0)


def _cross(a: NDArray[Any], b: NDArray[Any]) -> Floats:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])
