"""How good a map is, in a process of its own after the race: ``python -m benchmarks.speed.quality MESH MAP``."""

from __future__ import annotations

import json
import sys

import numpy as np
from numpy.typing import NDArray

import conformal_uv as cuv

__all__ = ["quality"]

Real = NDArray[np.float64]


def quality(V: Real, F: NDArray[np.int64], image: Real) -> dict[str, float]:
    """Numbers of a map to the plane or the sphere; a mirrored map is measured by its mirror image.

    Returns
    -------
    dict
        angle_mean, angle_max : degrees.
        energy : conformal energy over the area of the image.
        flips : faces with non-positive signed area.
        off_circle : greatest distance of a boundary vertex from the unit circle, or of a vertex from the sphere.
    """
    if not np.isfinite(image).all():
        return {"flips": float(len(F)), "not_finite": float((~np.isfinite(image)).any(axis=1).sum())}
    image = np.array(image, dtype=np.float64)
    if (signed_double_areas(image, F) < 0).sum() > len(F) / 2:
        image[:, 0] *= -1.0
    told = cuv.distortion(V, F, image)
    radius = np.linalg.norm(image, axis=1)
    if image.shape[1] == 2:
        radius = radius[boundary_vertices(F)]
    return {
        "angle_mean": told.angle_mean,
        "angle_max": told.angle_max,
        "energy": relative_energy(V, F, image),
        "flips": float(len(told.flipped)),
        "off_circle": float(np.abs(radius - 1.0).max()),
    }


def relative_energy(V: Real, F: NDArray[np.int64], image: Real) -> float:
    """Dirichlet energy less area of the image, over that area; faces without area are left out. It knows no scale.

    By the cotangents of the corners (Pinkall, Polthier 1993): ``1/4 sum cot |opposite side of the image|^2``.
    """
    sides = [V[F[:, (k + 2) % 3]] - V[F[:, (k + 1) % 3]] for k in range(3)]
    double = np.linalg.norm(np.cross(sides[0], sides[1]), axis=1)
    whole = double > 0.0
    dirichlet = 0.0
    for k in range(3):
        dot = -np.einsum("ij,ij->i", sides[(k + 1) % 3][whole], sides[(k + 2) % 3][whole])
        opposite = image[F[whole, (k + 2) % 3]] - image[F[whole, (k + 1) % 3]]
        dirichlet += 0.25 * float((dot / double[whole] * (opposite**2).sum(axis=1)).sum())
    area = 0.5 * float(signed_double_areas(image, F[whole]).sum())
    return (dirichlet - area) / area


def signed_double_areas(image: Real, F: NDArray[np.int64]) -> Real:
    """Twice the area of faces, negative where they are turned over; on the sphere as it is seen from outside."""
    a, b, c = (image[corner] for corner in F.T)
    if image.shape[1] == 2:
        (ux, uy), (vx, vy) = (b - a).T, (c - a).T
        return ux * vy - uy * vx
    normal = np.cross(b - a, c - a)
    return np.sign(np.einsum("ij,ij->i", a, normal)) * np.linalg.norm(normal, axis=1)


def boundary_vertices(F: NDArray[np.int64]) -> NDArray[np.int64]:
    """Vertices of edges that have one face only."""
    a, b = F.reshape(-1), F[:, [1, 2, 0]].reshape(-1)
    n = int(F.max()) + 1
    keys, count = np.unique(np.minimum(a, b) * n + np.maximum(a, b), return_counts=True)
    single = keys[count == 1]
    return np.unique(np.concatenate((single // n, single % n)))


if __name__ == "__main__":
    with np.load(sys.argv[1]) as arrays:
        mesh = arrays["V"], arrays["F"]
    print(json.dumps(quality(*mesh, np.load(sys.argv[2]))))
