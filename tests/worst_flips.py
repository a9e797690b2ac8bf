"""A good triangulation made bad on purpose."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from conformal_uv.mesh import Surface
from conformal_uv.operators.laplacian import cotangent_weights

FLATTEST = np.cos(np.radians(20.0))  # flips only where the four faces concerned lie within this of their mean plane


def worst_flips(V: NDArray[np.float64], F: NDArray[np.integer], share: float) -> NDArray[np.int64]:
    """Flip the best edges until `share` of the interior edges are not Delaunay; the surface hardly changes."""
    F = np.array(F, dtype=np.int64)
    for _ in range(50):
        surface = Surface.from_arrays(V, F)
        edges, m = surface.edges, surface.m
        weights = cotangent_weights(edges, surface.geometry)
        inner = edges.count == 2
        missing = share - (weights[inner] < 0).mean()
        if missing <= 0:
            break
        half = np.flatnonzero(edges.twin >= 0)
        half = half[half < edges.twin[half]]
        twin = edges.twin[half]
        corner = surface.corners.reshape(-1)
        a, b = corner[half], corner[(half + m) % (3 * m)]
        c, d = corner[(half + 2 * m) % (3 * m)], corner[(twin + 2 * m) % (3 * m)]
        old = _normals(V, a, b, c), _normals(V, b, a, d)
        mean = old[0] + old[1]
        faces = (*old, _normals(V, d, b, c), _normals(V, c, a, d))
        flat = np.min([_cosine(normal, mean) for normal in faces], axis=0) > FLATTEST
        present = set(zip(edges.lo.tolist(), edges.hi.tolist(), strict=True))
        order = np.argsort(-weights[edges.edge[half]])
        taken, budget = set(), int(missing * inner.sum()) + 1
        for k in order[(flat & (weights[edges.edge[half]] > 0))[order]].tolist():
            f, g = int(half[k] % m), int(twin[k] % m)
            key = (min(int(c[k]), int(d[k])), max(int(c[k]), int(d[k])))
            if f in taken or g in taken or key in present:
                continue
            taken |= {f, g}
            present.add(key)
            F[f], F[g] = (d[k], b[k], c[k]), (c[k], a[k], d[k])
            budget -= 1
            if not budget:
                break
    return F


def _normals(V: NDArray[np.float64], i: NDArray, j: NDArray, k: NDArray) -> NDArray[np.float64]:
    return np.cross(V[j] - V[i], V[k] - V[i])


def _cosine(x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    size = np.linalg.norm(x, axis=1) * np.linalg.norm(y, axis=1)
    return np.einsum("ij,ij->i", x, y) / np.maximum(size, 1e-300)
