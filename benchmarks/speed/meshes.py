"""The meshes, each made in a process of its own: ``python -m benchmarks.speed.meshes FAMILY SIZE OUT [FILE]``.

It prints the numbers of vertices and faces.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, Delaunay

from conformal_uv import triangulate
from conformal_uv.files import read_mesh
from conformal_uv.samples import mask, terrain

__all__ = ["from_file", "is_closed", "made", "opened", "save_mesh", "subdivided", "subdivision_sizes"]

Ints = NDArray[np.int64]
Mesh = tuple[NDArray[np.float64], Ints]

SEED = 7
BUMPS, NOISE = 0.5, 0.2  # height of the irregular terrain, and what chance adds in mean distances of its points


def made(family: str, size: int, file: Path | None = None) -> Mesh:
    """A mesh of about so many vertices, or islands; that of a file, opened for a family so named, is subdivided."""
    if file is not None:
        V, F = from_file(file)
        if is_closed(F) and family.endswith("-open"):
            V, F = without_unused(V, opened(F))
        while len(V) < size:
            V, F = subdivided(V, F)
        return V, F
    makers: dict[str, Callable[[], tuple[NDArray[np.float64], NDArray[Any]]]] = {
        "terrain": lambda: terrain(size, seed=SEED),
        "files": lambda: terrain(size, seed=SEED),
        "irregular": lambda: irregular_terrain(size),
        "round": lambda: mask(size, seed=SEED),
        "islands-4": lambda: islands(size, 2),
        "islands-25": lambda: islands(size, 5),
        "triangles": lambda: loose_triangles(size),
        "fan": lambda: fan(size),
        "ellipsoid": lambda: ellipsoid(size),
    }
    vertices, faces = makers[family]()
    return np.ascontiguousarray(vertices, dtype=np.float64), np.ascontiguousarray(faces, dtype=np.int64)


def irregular_terrain(count: int) -> Mesh:
    """Points by chance in a square and on its sides, joined by Delaunay's criterion in plan and numbered as they fell.

    Bumps and noise are such that on every size 17 % of the edges have a negative cotangent weight.
    """
    rng = np.random.default_rng(SEED)
    side = max(round(np.sqrt(count)), 2)
    along = [np.concatenate(([0.0], rng.uniform(size=side - 2))) for _ in range(4)]
    zero, one = np.zeros(side - 1), np.ones(side - 1)
    edge = [(along[0], zero), (one, along[1]), (1.0 - along[2], one), (zero, 1.0 - along[3])]
    inner = rng.uniform(size=(count - 4 * (side - 1), 2))
    xy = np.concatenate([*(np.column_stack(points) for points in edge), inner])
    F = Delaunay(xy).simplices.astype(np.int64)
    (ux, uy), (vx, vy) = (xy[F[:, 1]] - xy[F[:, 0]]).T, (xy[F[:, 2]] - xy[F[:, 0]]).T
    area = ux * vy - uy * vx
    F[area < 0] = F[area < 0][:, ::-1]
    x, y = xy.T
    z = NOISE / np.sqrt(count) * rng.uniform(-1.0, 1.0, count)
    for octave, (a, b) in enumerate(np.random.default_rng(SEED).uniform(0.0, 2.0 * np.pi, (4, 2))):
        frequency = 2.0**octave * np.pi
        z += BUMPS / 2.0**octave * np.sin(frequency * x + a) * np.sin(frequency * y + b)
    return without_unused(np.column_stack((xy, z)), F[area != 0.0])


def islands(count: int, side: int) -> Mesh:
    """Grids of side x side vertices in quadrangles, apart from each other, every position jittered in space."""
    row = np.arange(side, dtype=np.float64)
    grid = np.column_stack((np.tile(row, side), np.repeat(row, side), np.zeros(side * side)))
    number = np.arange(side * side).reshape(side, side)
    quads = np.stack((number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]), axis=-1).reshape(-1, 4)
    return _copies(grid, quads, count, float(side + 1))


def loose_triangles(count: int) -> Mesh:
    """Triangles apart from each other, no two alike."""
    corners = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.8, 0.0]])
    return _copies(corners, np.array([[0, 1, 2]]), count, 2.0)


def _copies(V: NDArray[np.float64], F: Ints, count: int, step: float) -> Mesh:
    """So many of a small mesh, in rows, each vertex moved by chance."""
    rng = np.random.default_rng(SEED)
    width = int(np.ceil(np.sqrt(count)))
    k = np.arange(count)
    place = step * np.column_stack((k % width, k // width, 0 * k))
    moved = place[:, None] + V + rng.uniform(-0.25, 0.25, (count, *V.shape))
    return moved.reshape(-1, 3), (F + len(V) * k[:, None, None]).reshape(-1, F.shape[1])


def fan(count: int) -> Mesh:
    """One vertex of the boundary joined to all others, which lie along a wavy arc about it."""
    turn = np.linspace(0.0, np.pi, count - 1)
    arc = np.column_stack((np.cos(turn), np.sin(turn), 0.2 * np.sin(7.0 * turn)))
    k = np.arange(1, count - 1)
    return np.concatenate((np.zeros((1, 3)), arc)), np.column_stack((0 * k, k, k + 1))


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
    return without_unused(mesh.V, triangulate(mesh)[0].astype(np.int64))


def without_unused(V: NDArray[np.float64], F: Ints) -> Mesh:
    """The vertices of the faces alone."""
    used, numbers = np.unique(F, return_inverse=True)
    return np.ascontiguousarray(V[used]), numbers.reshape(F.shape).astype(np.int64)


def is_closed(F: Ints) -> bool:
    """Whether every edge has two faces."""
    return bool((np.unique(_sides(F), return_counts=True)[1] == 2).all())


def opened(F: Ints) -> Ints:
    """The faces without those around a vertex."""
    return F[~(F == F[0, 0]).any(axis=1)]


def subdivided(V: NDArray[np.float64], F: Ints) -> Mesh:
    """Every triangle cut into four at the midpoints of its sides."""
    n = len(V)
    keys, side = np.unique(_sides(F), return_inverse=True)
    ends = np.divmod(keys, int(F.max()) + 1)
    ab, bc, ca = (n + side.reshape(-1, 3)).T
    a, b, c = F.T
    faces = np.concatenate([np.column_stack(t) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return np.concatenate((V, 0.5 * (V[ends[0]] + V[ends[1]]))), faces.astype(np.int64)


def subdivision_sizes(F: Ints, largest: int) -> tuple[int, ...]:
    """Vertices of a mesh and of its subdivisions, up to about the largest."""
    n, edges, m = len(np.unique(F)), len(np.unique(_sides(F))), len(F)
    sizes = []
    while n <= 1.2 * largest:
        sizes.append(n)
        n, edges, m = n + edges, 2 * edges + 3 * m, 4 * m
    return tuple(sizes)


def _sides(F: Ints) -> Ints:
    """A number for the edge of each side of the faces, face after face."""
    a, b = F, F[:, [1, 2, 0]]
    return (np.minimum(a, b) * (int(F.max()) + 1) + np.maximum(a, b)).reshape(-1)


def save_mesh(path: Path, family: str, mesh: Mesh) -> None:
    """V and F as the contestants get them; for islands and fans also a terrain of as many vertices."""
    V, F = mesh
    told = {"V": V, "F": F}
    if family.startswith("islands") or family == "fan":
        told["disk_V"], told["disk_F"] = made("terrain", len(V))
    np.savez(path, **told)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("family")
    parser.add_argument("size", type=int)
    parser.add_argument("out", type=Path)
    parser.add_argument("file", type=Path, nargs="?")
    given = parser.parse_args()
    mesh = made(given.family, given.size, given.file)
    save_mesh(given.out, given.family, mesh)
    print(*map(len, mesh))
