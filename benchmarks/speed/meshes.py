"""The meshes, each made in a process of its own: ``python -m benchmarks.speed.meshes FAMILY SIZE OUT [FILE]``.

It prints the numbers of vertices and faces.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from conformal_uv.files import read_mesh
from conformal_uv.mesh.triangulate import triangulate
from conformal_uv.samples import terrain

__all__ = ["FAMILIES", "from_file", "save_mesh", "subdivided"]

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]

SEED = 7
FAMILIES = ("terrain", "face", "ellipsoid")


def made(family: str, size: int, file: Path | None = None) -> Mesh:
    """A mesh of about so many vertices; `face` takes those of the file, subdivided while they are fewer."""
    if family == "face":
        if file is None:
            raise ValueError("the face is subdivided from a file: give --face FILE")
        V, F = from_file(file)
        while len(V) < size:
            V, F = subdivided(V, F)
        return V, F
    makers: dict[str, Callable[[], tuple[NDArray[np.float64], NDArray[np.integer]]]] = {
        "terrain": lambda: terrain(size, seed=SEED),
        "ellipsoid": lambda: ellipsoid(size),
    }
    vertices, faces = makers[family]()
    return np.ascontiguousarray(vertices, dtype=np.float64), np.ascontiguousarray(faces, dtype=np.int64)


def ellipsoid(count: int) -> Mesh:
    """Axes 1 : 1.5 : 2.5 over the convex hull of spiral points of the sphere."""
    k = np.arange(count) + 0.5
    z, turn = 1 - 2 * k / count, np.pi * (1 + np.sqrt(5)) * k
    ring = np.sqrt(1 - z * z)
    P = np.column_stack((ring * np.cos(turn), ring * np.sin(turn), z))
    F = ConvexHull(P).simplices.astype(np.int64)
    inward = np.linalg.det(P[F]) < 0
    F[inward] = F[inward][:, ::-1]
    return P * [1.0, 1.5, 2.5], F


def from_file(path: Path) -> Mesh:
    """Triangles of a mesh file, without vertices that no face uses."""
    mesh = read_mesh(path).mesh
    faces, _, _ = triangulate(mesh)
    used, F = np.unique(faces, return_inverse=True)
    return np.ascontiguousarray(mesh.V[used]), F.reshape(-1, 3).astype(np.int64)


def subdivided(V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    """Every triangle cut into four at the midpoints of its sides."""
    n = len(V)
    a, b = F, F[:, [1, 2, 0]]
    keys, side = np.unique((np.minimum(a, b) * n + np.maximum(a, b)).reshape(-1), return_inverse=True)
    ab, bc, ca = (n + side.reshape(-1, 3)).T
    a, b, c = F.T
    faces = np.concatenate([np.column_stack(t) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return np.concatenate((V, 0.5 * (V[keys // n] + V[keys % n]))), faces.astype(np.int64)


def subdivision_sizes(path: Path, largest: int) -> list[int]:
    """Vertices of a file's mesh and of its subdivisions, up to about the largest."""
    V, F = from_file(path)
    n, m = len(V), len(F)
    a, b = F, F[:, [1, 2, 0]]
    edges = len(np.unique(np.minimum(a, b) * n + np.maximum(a, b)))
    sizes = []
    while n <= 1.2 * largest:
        sizes.append(n)
        n, edges, m = n + edges, 2 * edges + 3 * m, 4 * m
    return sizes


def save_mesh(path: Path, mesh: Mesh) -> None:
    """V and F as the contestants get them."""
    np.savez(path, V=mesh[0], F=mesh[1])


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("family", choices=FAMILIES)
    parser.add_argument("size", type=int)
    parser.add_argument("out", type=Path)
    parser.add_argument("file", type=Path, nargs="?")
    given = parser.parse_args()
    mesh = made(given.family, given.size, given.file)
    save_mesh(given.out, mesh)
    print(*map(len, mesh))
