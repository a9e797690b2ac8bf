"""Small meshes made by hand, good and broken: each builder returns (V, F) or works on them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay

__all__ = [
    "annulus",
    "disjoint",
    "fan",
    "glued",
    "icosahedron",
    "identified",
    "moebius_band",
    "octahedron",
    "plate",
    "refined",
    "scattered_disk",
    "slow_loops",
    "strip",
    "tetrahedron",
    "torus",
    "wheel",
]

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]


def strip(quads: int) -> Mesh:
    """A straight row of quads, each cut in two: no interior vertex, every second edge a chord."""
    x = np.arange(quads + 1.0)
    V = np.concatenate([np.column_stack((x, np.full_like(x, y), np.zeros_like(x))) for y in (0.0, 1.0)])
    a = np.arange(quads)
    up = a + quads + 1
    return V, np.concatenate((np.column_stack((a, a + 1, up + 1)), np.column_stack((a, up + 1, up))))


def fan(triangles: int) -> Mesh:
    """Triangles around one boundary vertex (number 0), spread over 150 degrees: no interior vertex."""
    t = np.linspace(0.0, np.radians(150.0), triangles + 1)
    V = np.concatenate((np.zeros((1, 3)), np.column_stack((np.cos(t), np.sin(t), 0.2 * t))))
    k = np.arange(1, triangles + 1)
    return V, np.column_stack((np.zeros_like(k), k, k + 1))


def wheel(spokes: int, height: float = 0.3) -> Mesh:
    """A flat pyramid: vertex 0 in the middle, the others around it."""
    t = 2.0 * np.pi / spokes * np.arange(spokes)
    V = np.concatenate(([[0.0, 0.0, height]], np.column_stack((np.cos(t), np.sin(t), 0.0 * t))))
    k = np.arange(spokes)
    return V, np.column_stack((np.zeros_like(k), k + 1, (k + 1) % spokes + 1))


def plate(columns: int, rows: int, holes: tuple[tuple[int, int, int, int], ...] = ()) -> Mesh:
    """A grid of columns x rows unit quads, bent a little; holes are (column, row, width, height) in quads.

    Vertices that only the holes' quads would use are left out.
    """
    x, y = (g.reshape(-1) for g in np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0)))
    V = np.column_stack((x, y, 0.1 * np.sin(0.7 * x + 0.4 * y)))
    number = np.arange((rows + 1) * (columns + 1)).reshape(rows + 1, columns + 1)
    kept = np.ones((rows, columns), dtype=bool)
    for column, row, width, height in holes:
        kept[row : row + height, column : column + width] = False
    a, b, c, d = (q[kept] for q in (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]))
    F = np.concatenate((np.column_stack((a, b, c)), np.column_stack((a, c, d))))
    used, F = np.unique(F, return_inverse=True)
    return V[used], F.reshape(-1, 3)


def scattered_disk(inner: int, around: int, seed: int) -> Mesh:
    """Delaunay triangulation of random points in the unit disk, slivers and all; boundary vertices first."""
    rng = np.random.default_rng(seed)
    radius, t = 0.98 * np.sqrt(rng.random(inner)), 2.0 * np.pi * rng.random(inner)
    rim = 2.0 * np.pi * np.arange(around) / around
    x = np.concatenate((np.cos(rim), radius * np.cos(t)))
    y = np.concatenate((np.sin(rim), radius * np.sin(t)))
    V = np.column_stack((x, y, 0.0 * x))
    F = Delaunay(V[:, :2]).simplices.astype(np.int64)
    clockwise = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])[:, 2] < 0
    F[clockwise] = F[clockwise, ::-1]
    return V, F


def annulus(around: int) -> Mesh:
    """A flat ring: inner vertices 0 .. around - 1, outer ones after them, both anticlockwise."""
    t = 2.0 * np.pi / around * np.arange(around)
    circle = np.column_stack((np.cos(t), np.sin(t), 0.0 * t))
    a = np.arange(around)
    b = (a + 1) % around
    return np.concatenate((circle, 2.0 * circle)), np.concatenate(
        (np.column_stack((a, a + around, b + around)), np.column_stack((a, b + around, b)))
    )


def moebius_band(around: int) -> Mesh:
    """A band of quads with half a twist."""
    t = 2.0 * np.pi / around * np.arange(around)
    radial = np.column_stack((np.cos(t), np.sin(t), 0.0 * t))
    across = 0.3 * (np.cos(t / 2)[:, None] * radial + np.sin(t / 2)[:, None] * [0.0, 0.0, 1.0])
    a, b = np.arange(around), np.arange(around) + around
    c, d = np.roll(b, -1), np.roll(a, -1)
    c[-1], d[-1] = a[0], b[0]  # the twist
    F = np.concatenate((np.column_stack((a, b, c)), np.column_stack((a, c, d))))
    return np.concatenate((radial - across, radial + across)), F


def torus(around: int = 6, tube: int = 5) -> Mesh:
    """A closed torus, wound to face outwards."""
    s, t = np.meshgrid(2 * np.pi / around * np.arange(around), 2 * np.pi / tube * np.arange(tube), indexing="ij")
    r = 2.0 + 0.7 * np.cos(t)
    V = np.stack((r * np.cos(s), r * np.sin(s), 0.7 * np.sin(t)), axis=-1).reshape(-1, 3)
    a = np.arange(around * tube).reshape(around, tube)
    b, d = np.roll(a, -1, axis=0), np.roll(a, -1, axis=1)
    c = np.roll(b, -1, axis=1)
    quads = [q.reshape(-1) for q in (a, b, c, d)]
    return V, np.concatenate((np.column_stack(quads[:3]), np.column_stack((quads[0], quads[2], quads[3]))))


def tetrahedron() -> Mesh:
    """A regular tetrahedron on the unit sphere, wound to face outwards."""
    V = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(3.0)
    return V, np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])


def octahedron() -> Mesh:
    """The regular octahedron on the unit sphere, wound to face outwards; 0 and 1, 2 and 3, 4 and 5 are opposite."""
    V = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float)
    F = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    return V, np.array(F)


def icosahedron() -> Mesh:
    """The regular icosahedron on the unit sphere, wound to face outwards."""
    p = (1.0 + np.sqrt(5.0)) / 2.0
    V = np.array(
        [[-1, p, 0], [1, p, 0], [-1, -p, 0], [1, -p, 0], [0, -1, p], [0, 1, p]]
        + [[0, -1, -p], [0, 1, -p], [p, 0, -1], [p, 0, 1], [-p, 0, -1], [-p, 0, 1]]
    ) / np.sqrt(1.0 + p * p)
    F = [[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6]]
    F += [[7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10]]
    return V, np.array([*F, [8, 6, 7], [9, 8, 1]])


def disjoint(one: Mesh, other: Mesh) -> Mesh:
    """Both meshes, the second beside the first."""
    shift = [one[0][:, 0].max() - other[0][:, 0].min() + 1.0, 0.0, 0.0]
    return np.concatenate((one[0], other[0] + shift)), np.concatenate((one[1], other[1] + len(one[0])))


def glued(one: Mesh, other: Mesh, pairs: list[tuple[int, int]]) -> Mesh:
    """Both meshes with vertices (of the first, of the second) made one; those of the first keep their numbers."""
    V, F = disjoint(one, other)
    return identified((V, F), [(a, b + len(one[0])) for a, b in pairs])


def identified(mesh: Mesh, pairs: list[tuple[int, int]]) -> Mesh:
    """The mesh with the second vertex of each pair replaced by the first and left out."""
    V, F = mesh
    name = np.arange(len(V))
    for kept, gone in pairs:
        name[gone] = kept
    used, F = np.unique(name[F], return_inverse=True)
    return V[used], F.reshape(-1, 3)


def refined(mesh: Mesh, place) -> Mesh:
    """Every triangle cut into four; `place(midpoints, ends_on_boundary)` says where the midpoints go.

    Old vertices keep their numbers.
    """
    V, F = mesh
    sides = np.sort(np.concatenate((F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]])), axis=1)
    ends, number, count = np.unique(sides, axis=0, return_inverse=True, return_counts=True)
    middle = place(0.5 * (V[ends[:, 0]] + V[ends[:, 1]]), count == 1)
    ab, bc, ca = number.reshape(3, -1) + len(V)
    a, b, c = F.T
    parts = ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
    return np.concatenate((V, middle)), np.concatenate([np.column_stack(part) for part in parts])


def slow_loops(F: NDArray[np.integer]) -> list[list[int]]:
    """Boundary loops, half-edge by half-edge in reading order: the independent tracer."""
    directed = [(int(f[k]), int(f[(k + 1) % 3])) for f in F for k in range(3)]
    present = set(directed)
    following = {a: b for a, b in directed if (b, a) not in present}
    loops, seen = [], set()
    for a, b in directed:
        if (b, a) in present or a in seen:
            continue
        loop = []
        while a not in seen:
            seen.add(a)
            loop.append(a)
            a = following[a]
        loops.append(loop)
    return loops
