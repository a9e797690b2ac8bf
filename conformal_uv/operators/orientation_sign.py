"""Exact signs of the areas of plane triangles with floating-point corners.

J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997: the
rounded determinant has the right sign when it exceeds a bound on its error; the few others are computed exactly.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from ..mesh.blocks import blocks

__all__ = ["flipped_faces", "orientation_signs"]

EPS = 0.5 * np.finfo(np.float64).eps
ERROR_BOUND = (3.0 + 16.0 * EPS) * EPS


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
    unsure = []
    for part in blocks(len(signs)):
        here = corners[:, part].astype(np.intp)
        (ax, bx, cx), (ay, by, cy) = x.take(here), y.take(here)
        left = (ax - cx) * (by - cy)
        right = (ay - cy) * (bx - cx)
        area = left - right
        signs[part] = np.sign(area)
        unsure.append(part.start + np.flatnonzero(np.abs(area) <= ERROR_BOUND * (np.abs(left) + np.abs(right))))
    doubtful = np.concatenate(unsure) if unsure else np.empty(0, dtype=np.int64)
    if len(doubtful):
        signs[doubtful] = _exact(uv, corners[:, doubtful])
    return signs


def flipped_faces(z: NDArray[np.complex128], corners: NDArray[np.int32]) -> NDArray[np.int64]:
    """Faces with non-positive area in the plane, decided exactly."""
    return np.flatnonzero(orientation_signs(np.ascontiguousarray(z).view(np.float64).reshape(-1, 2), corners) <= 0)


def _exact(uv: NDArray[np.float64], corners: NDArray[np.int32]) -> NDArray[np.int8]:
    """The same in rational arithmetic; triangles with two equal corners need none."""
    a, b, c = uv[corners[0]], uv[corners[1]], uv[corners[2]]
    out = np.zeros(corners.shape[1], dtype=np.int8)
    apart = (a != b).any(axis=1) & (b != c).any(axis=1) & (c != a).any(axis=1)
    for k in np.flatnonzero(apart):
        (ax, ay), (bx, by), (cx, cy) = ((Fraction(p[0]), Fraction(p[1])) for p in (a[k], b[k], c[k]))
        area = (ax - cx) * (by - cy) - (ay - cy) * (bx - cx)
        out[k] = (area > 0) - (area < 0)
    return out
