"""The kinds of mesh that break flatteners, each by its name."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from conformal_uv.samples import flat_disk, mask

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]


def grid(columns: int, rows: int, width: float, height: float) -> Mesh:
    """A plane rectangle of quadrangles cut in two."""
    number = np.arange(columns * rows).reshape(rows, columns)
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    F = np.concatenate((np.stack((a, b, c), -1).reshape(-1, 3), np.stack((a, c, d), -1).reshape(-1, 3)))
    x, y = np.meshgrid(np.linspace(0, width, columns), np.linspace(0, height, rows))
    return np.column_stack((x.reshape(-1), y.reshape(-1), np.zeros(columns * rows))), F


def finger(length: float, around: int = 24) -> Mesh:
    """A tube of diameter 1, shut at one end."""
    rings = int(length * around / np.pi) + 1
    turn = 2 * np.pi * np.arange(around) / around
    circle = 0.5 * np.column_stack((np.cos(turn), np.sin(turn)))
    V = np.column_stack((np.tile(circle, (rings, 1)), np.repeat(np.linspace(0, length, rings), around)))
    a = np.arange((rings - 1) * around)
    b = a + 1 - around * (a % around == around - 1)
    rim = np.arange((rings - 1) * around, rings * around)
    lid = np.column_stack((rim, np.roll(rim, -1), np.full(around, len(V))))
    F = np.concatenate((np.column_stack((a, b, b + around)), np.column_stack((a, b + around, a + around)), lid))
    return np.vstack((V, [0, 0, length])), F


def maze(lanes: int = 6, width: int = 4) -> Mesh:
    """A band that winds to and fro."""
    long = lanes * (width + 1)
    cells = [(lane * (width + 1) + x, y) for lane in range(lanes) for x in range(width) for y in range(long)]
    for lane in range(lanes - 1):
        bend = range(long - width, long) if lane % 2 == 0 else range(width)
        cells += [(lane * (width + 1) + width, y) for y in bend]
    x, y = np.array(sorted(cells)).T
    square = np.stack(((x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)))
    points, F = np.unique(square.transpose(2, 0, 1).reshape(-1, 2), axis=0, return_inverse=True)
    a, b, c, d = F.reshape(-1, 4).T
    return np.column_stack((points, np.zeros(len(points)))).astype(float), np.concatenate(
        (np.column_stack((a, b, c)), np.column_stack((a, c, d)))
    )


def band(count: int = 20) -> Mesh:
    """A Moebius band."""
    turn = np.repeat(2 * np.pi * np.arange(count) / count, 2)
    across = np.tile([-0.3, 0.3], count)
    ring = 1 + across * np.cos(turn / 2)
    V = np.column_stack((ring * np.cos(turn), ring * np.sin(turn), across * np.sin(turn / 2)))
    p = 2 * np.arange(count)
    r, s = np.roll(p, -1), np.roll(p, -1) + 1
    r[-1], s[-1] = 1, 0
    return V, np.concatenate((np.column_stack((p, r, p + 1)), np.column_stack((p + 1, r, s))))


def torus(count: int = 12) -> Mesh:
    """A ring."""
    number = np.arange(count * count).reshape(count, count)
    b, d = np.roll(number, -1, axis=1), np.roll(number, -1, axis=0)
    c = np.roll(d, -1, axis=1)
    u, v = (2 * np.pi * x.reshape(-1) / count for x in np.meshgrid(np.arange(count), np.arange(count)))
    V = np.column_stack(((2 + np.cos(u)) * np.cos(v), (2 + np.cos(u)) * np.sin(v), np.sin(u)))
    return V, np.concatenate((np.stack((number, b, c), -1).reshape(-1, 3), np.stack((number, c, d), -1).reshape(-1, 3)))


def sphere(count: int = 300) -> Mesh:
    """The convex hull of random points of the unit sphere."""
    P = np.random.default_rng(1).normal(size=(count, 3))
    P /= np.linalg.norm(P, axis=1, keepdims=True)
    F = ConvexHull(P).simplices
    inward = np.einsum("ij,ij->i", np.cross(P[F[:, 1]] - P[F[:, 0]], P[F[:, 2]] - P[F[:, 0]]), P[F[:, 0]]) < 0
    F[inward] = F[inward][:, ::-1]
    return P, F


def flattened(V: NDArray[np.float64], F: NDArray[np.int64], count: int, left: float, seed: int = 1) -> Mesh:
    """The mesh with one corner of some faces brought to `left` of its way from the middle of the other two."""
    V = V.copy()
    for a, b, c in F[np.random.default_rng(seed).choice(len(F), count, replace=False)]:
        middle = 0.5 * (V[a] + V[b])
        V[c] = middle + left * (V[c] - middle)
    return V, F


def changed(mesh: Mesh, **places: object) -> Mesh:
    """The mesh with some vertices moved: v17=(...)."""
    V, F = mesh[0].copy(), mesh[1]
    for name, position in places.items():
        V[int(name[1:])] = position
    return V, F


def _annulus() -> Mesh:
    V, F = flat_disk(2000)
    used, F = np.unique(F[np.hypot(*V[F].mean(axis=1)[:, :2].T) > 0.4], return_inverse=True)
    return V[used], F.reshape(-1, 3)


def _spike() -> Mesh:
    V, F = MASK
    top = int(np.argmin(np.hypot(V[:, 0], V[:, 1])))
    edge = np.sqrt(np.ptp(V[:, 0]) ** 2 / len(V))
    return changed(MASK, **{f"v{top}": V[top] + [0, 0, 1e4 * edge]})


def _tail() -> Mesh:
    V, F = flat_disk(2000)
    V = V.copy()
    radius, angle = np.hypot(V[:, 0], V[:, 1]), np.arctan2(V[:, 1], V[:, 0])
    V[:, 0] += 5 * np.exp(-((angle / 0.05) ** 2)) * radius**8
    return V, F


def _ear() -> Mesh:
    V, F = grid(10, 10, 1, 1)
    return np.vstack((V, [0.05, -0.1, 0])), np.vstack((F, [0, len(V), 1]))


def _fan() -> Mesh:
    turn = np.linspace(0, 1.5 * np.pi, 20)
    V = np.vstack(([0, 0, 0], np.column_stack((np.cos(turn), np.sin(turn), 0 * turn))))
    k = np.arange(1, 20)
    return V, np.column_stack((0 * k, k, k + 1))


def _misoriented() -> Mesh:
    F = MASK[1].copy()
    F[50] = F[50][::-1]
    return MASK[0], F


MASK = mask(3000)
V0, F0 = MASK
CORNER = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])

EMBEDDED: dict[str, Mesh] = {
    "one triangle": (CORNER, np.array([[0, 1, 2]])),
    "two triangles": (np.vstack((CORNER, [1, 1, 0])), np.array([[0, 1, 2], [1, 3, 2]])),
    "strip without interior vertex": grid(20, 2, 1, 1),
    "fan without interior vertex": _fan(),
    "ear triangle": _ear(),
    "spike 1e4 edges long": _spike(),
    "thin tail": _tail(),
    "x stretched by 200": (V0 * [200, 1, 1], F0),
    "x stretched by 1e5": (V0 * [1e5, 1, 1], F0),
    "100 slivers below 0.1 degrees": flattened(V0, F0, 100, 5e-4),
    "coincident vertices": changed(MASK, **{f"v{F0[100, 0]}": V0[F0[100, 1]]}),
    "zero-area faces": flattened(V0, F0, 30, 0.0),
    "scale 1e-12": (V0 * 1e-12, F0),
    "scale 1e12": (V0 * 1e12, F0),
    "shifted by 1e7": (V0 + 1e7, F0),
    "ribbon 1 x 25": grid(201, 9, 25, 1),
    "ribbon 1 x 100": grid(801, 9, 100, 1),
    "serpentine maze": maze(),
    "tube of 3 diameters": finger(3),
    "tube of 6 diameters": finger(6),
    "tube of 10 diameters": finger(10),
    "tube of 30 diameters": finger(30),
}

REFUSED: dict[str, tuple[str, Mesh]] = {
    "NaN": ("NonFiniteError", changed(MASK, v17=(np.nan, 0, 0))),
    "soup": ("DisconnectedError", (np.random.default_rng(0).random((90, 3)), np.arange(90).reshape(-1, 3))),
    "unreferenced vertex": ("UnreferencedVertexError", (np.vstack((V0, [0, 0, 0])), F0)),
    "duplicate face": ("DuplicateFaceError", (V0, np.vstack((F0, F0[:1])))),
    "misoriented face": ("OrientationError", _misoriented()),
    "annulus": ("TopologyError", _annulus()),
    "two components": ("DisconnectedError", (np.vstack((V0, V0 + 1)), np.vstack((F0, F0 + len(V0))))),
    "bow-tie": ("NonManifoldError", (np.vstack((CORNER, -CORNER[1:])), np.array([[0, 1, 2], [0, 3, 4]]))),
    "Moebius band": ("OrientationError", band()),
    "closed sphere": ("TopologyError", sphere()),
    "torus": ("TopologyError", torus()),
    "non-manifold edge": (
        "NonManifoldError",
        (np.vstack((CORNER, [[0, -1, 0], [0, 0, 1]])), np.array([[0, 1, 2], [1, 0, 3], [0, 1, 4]])),
    ),
}
