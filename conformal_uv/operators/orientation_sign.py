"""Exact signs of the areas of triangles with floating-point corners, in the plane or seen from inside a sphere.

J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997: the
rounded determinant has the right sign when it exceeds a bound on its error; the few others are computed exactly.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from ..mesh.blocks import by_blocks

__all__ = ["collapsed_faces", "flipped_faces", "inverted_faces", "orientation_signs", "outward_signs"]

EPS = 0.5 * np.finfo(np.float64).eps
ERROR_BOUND = (3.0 + 16.0 * EPS) * EPS
# Of a . ((b - a) x (c - a)): two differences, two products, a difference, a product and two sums, each wrong by EPS.
VOLUME_BOUND = 9.0 * EPS
FLAT = 1e-12  # height over longest edge


def orientation_signs(uv: NDArray[np.float64], corners: NDArray[np.int32]) -> NDArray[np.int8]:
    """+1 for triangles wound anticlockwise, -1 for clockwise, 0 for those without area.

    Parameters
    ----------
    uv : (n, 2) float64
        Finite positions; the signs are those of exactly these numbers.
    corners : (3, m) int32

    Returns
    -------
    (m,) int8
    """
    x, y = np.ascontiguousarray(uv[:, 0]), np.ascontiguousarray(uv[:, 1])
    signs = np.empty(corners.shape[1], dtype=np.int8)

    def rounded(part: slice) -> NDArray[np.int64]:
        here = corners[:, part].astype(np.intp)
        (ax, bx, cx), (ay, by, cy) = x.take(here), y.take(here)
        left = (ax - cx) * (by - cy)
        right = (ay - cy) * (bx - cx)
        area = left - right
        signs[part] = np.sign(area)
        return part.start + np.flatnonzero(np.abs(area) <= ERROR_BOUND * (np.abs(left) + np.abs(right)))

    doubtful = _together(by_blocks(rounded, len(signs)))
    if len(doubtful):
        signs[doubtful] = _exact(uv, corners[:, doubtful])
    return signs


def outward_signs(x: NDArray[np.float64], corners: NDArray[np.int32]) -> NDArray[np.int8]:
    """+1 for triangles that are anticlockwise seen from outside a sphere around the origin, -1 for clockwise, 0 for
    those in one plane with the origin.

    Parameters
    ----------
    x : (n, 3) float64
        Finite positions; the signs are those of exactly these numbers.
    corners : (3, m) int32

    Returns
    -------
    (m,) int8
    """
    columns = np.ascontiguousarray(x.T)
    signs = np.empty(corners.shape[1], dtype=np.int8)

    def rounded(part: slice) -> NDArray[np.int64]:
        here = corners[:, part].astype(np.intp)
        a, b, c = (columns.take(corner, axis=1) for corner in here)
        u, v = b - a, c - a
        volume, size = np.zeros(here.shape[1]), np.zeros(here.shape[1])
        for i in range(3):
            left, right = u[i - 2] * v[i - 1], u[i - 1] * v[i - 2]
            volume += a[i] * (left - right)
            size += np.abs(a[i]) * (np.abs(left) + np.abs(right))
        signs[part] = np.sign(volume)
        return part.start + np.flatnonzero(np.abs(volume) <= VOLUME_BOUND * size)

    doubtful = _together(by_blocks(rounded, len(signs)))
    if len(doubtful):
        signs[doubtful] = _exact_volumes(x, corners[:, doubtful])
    return signs


def flipped_faces(z: NDArray[np.complex128], corners: NDArray[np.int32]) -> NDArray[np.int64]:
    """Faces with non-positive area in the plane, decided exactly."""
    return np.flatnonzero(orientation_signs(np.ascontiguousarray(z).view(np.float64).reshape(-1, 2), corners) <= 0)


def collapsed_faces(z: NDArray[np.complex128], corners: NDArray[np.int32]) -> NDArray[np.int64]:
    """Faces that are flipped, or flat but for rounding, which may have decided how they are wound."""
    x, y = np.ascontiguousarray(z.real), np.ascontiguousarray(z.imag)

    def flat(part: slice) -> NDArray[np.int64]:
        here = corners[:, part].astype(np.intp)
        (ax, bx, cx), (ay, by, cy) = x.take(here), y.take(here)
        left = (ax - cx) * (by - cy)
        right = (ay - cy) * (bx - cx)
        return part.start + np.flatnonzero(left - right <= FLAT * (np.abs(left) + np.abs(right)))

    return _together(by_blocks(flat, corners.shape[1]))


def inverted_faces(x: NDArray[np.float64], corners: NDArray[np.int32]) -> NDArray[np.int64]:
    """Faces that are not anticlockwise seen from outside a sphere around the origin, decided exactly."""
    return np.flatnonzero(outward_signs(x, corners) <= 0)


def _together(parts: list[NDArray[np.int64]]) -> NDArray[np.int64]:
    return np.concatenate(parts) if parts else np.empty(0, dtype=np.int64)


def _apart(points: NDArray[np.float64], corners: NDArray[np.int32]) -> NDArray[np.int64]:
    """Triangles without two equal corners."""
    a, b, c = (points[corner] for corner in corners)
    return np.flatnonzero((a != b).any(axis=1) & (b != c).any(axis=1) & (c != a).any(axis=1))


def _exact_volumes(x: NDArray[np.float64], corners: NDArray[np.int32]) -> NDArray[np.int8]:
    """Signs of a . (b x c) in rational arithmetic."""
    out = np.zeros(corners.shape[1], dtype=np.int8)
    for k in _apart(x, corners):
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (map(Fraction, x[v].tolist()) for v in corners[:, k])
        volume = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        out[k] = (volume > 0) - (volume < 0)
    return out


def _exact(uv: NDArray[np.float64], corners: NDArray[np.int32]) -> NDArray[np.int8]:
    """The same in rational arithmetic; triangles with two equal corners need none."""
    out = np.zeros(corners.shape[1], dtype=np.int8)
    for k in _apart(uv, corners):
        (ax, ay), (bx, by), (cx, cy) = (map(Fraction, uv[v].tolist()) for v in corners[:, k])
        area = (ax - cx) * (by - cy) - (ay - cy) * (bx - cx)
        out[k] = (area > 0) - (area < 0)
    return out
