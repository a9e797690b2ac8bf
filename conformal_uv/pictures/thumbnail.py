"""A small picture of a map without a plotting library: the surface with its checker, and the map beside it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mapped_mesh import MappedMesh
from ..options import Upright
from .first_view import seen_triangles
from .raster import SAMPLES, faces_in_front

__all__ = ["thumbnail"]

Real = NDArray[np.float64]

SIZE = 220  # pixels of each half
SQUARES = 12  # of the checker, across the map
ROOM = 0.94  # of a half that is filled
LIGHT, DARK = np.array([246.0, 243.0, 234.0]), np.array([61.0, 111.0, 165.0])


def thumbnail(mapped: MappedMesh, upright: Upright = Upright.Z) -> NDArray[np.uint8]:
    """An image (220, 440, 4), the highest row first; transparent where nothing is."""
    surface, depth, shade = seen_triangles(mapped.V[mapped.F], upright)
    image = mapped.image[mapped.F]
    if image.shape[2] == 3:
        ball, near, _ = seen_triangles(image)
        return np.hstack((_half(surface, depth, image, shade), _half(ball, near, image, shade)))
    flat = np.zeros(len(image))
    return np.hstack((_half(surface, depth, image, shade), _half(image, flat, image, shade)))


def _half(triangles: Real, depth: Real, image: Real, shade: Real) -> NDArray[np.uint8]:
    """Triangles (m, 3, 2) with the checker of their images (m, 3, 2 or 3), in the brightness (m, 4)."""
    side = SAMPLES * SIZE
    low, high = triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))
    scale = ROOM * side / max(float((high - low).max()), 1e-300)
    order = np.argsort(depth, kind="stable")
    placed = ((triangles - 0.5 * (low + high)) * scale + 0.5 * side)[order]
    faces = faces_in_front(placed, (side, side))
    row, column = np.nonzero(faces >= 0)
    face = faces[row, column]
    weights = _barycentric(placed[face], np.column_stack((column, row)) + 0.5)
    white = _checker(np.einsum("ij,ijk->ik", weights, image[order[face]]), image)
    colour = np.where(white[:, None], LIGHT, DARK) * np.sqrt(shade[order[face], :1])
    samples = np.zeros((side, side, 4))
    samples[row, column] = np.column_stack((np.clip(colour, 0.0, 255.0), np.full(len(row), 255.0)))
    sums = samples.reshape(SIZE, SAMPLES, SIZE, SAMPLES, 4).sum(axis=(1, 3))
    covered = np.maximum(sums[:, :, 3:], 1.0) / 255.0
    pixels = np.concatenate((sums[:, :, :3] / covered, sums[:, :, 3:] / SAMPLES**2), axis=2)
    return (pixels[::-1] + 0.5).astype(np.uint8)


def _barycentric(triangles: Real, points: Real) -> Real:
    """Weights (k, 3) of the corners of k triangles (k, 3, 2) at k points in them."""
    a, b, c = (triangles[:, corner] - points for corner in range(3))
    weights = np.stack([p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0] for p, q in ((b, c), (c, a), (a, b))], axis=1)
    total = weights.sum(axis=1, keepdims=True)
    return np.divide(weights, total, out=np.full_like(weights, 1.0 / 3.0), where=total != 0.0)


def _checker(points: Real, image: Real) -> NDArray[np.bool_]:
    """Which squares are light at points of the map; on the sphere of a cube's sides."""
    if points.shape[1] == 3:
        largest = np.argmax(np.abs(points), axis=1)
        main = np.take_along_axis(points, largest[:, None], axis=1)
        others = (largest[:, None] + [1, 2]) % 3
        points = np.arctan(np.take_along_axis(points, others, axis=1) / main) / (0.5 * np.pi) + 0.5
        return np.floor(points * (SQUARES // 2)).sum(axis=1) % 2 == 0
    low, high = image.min(axis=(0, 1)), image.max(axis=(0, 1))
    width = max(float((high - low).max()), 1e-300) / SQUARES
    return np.floor((points - 0.5 * (low + high)) / width).sum(axis=1) % 2 == 0
