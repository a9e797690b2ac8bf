"""Meshes of every kind by number: the same seed always gives the same mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay

from conformal_uv.samples import flat_disk

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]


def random_mesh(seed: int) -> Mesh:
    """A base surface with up to three kinds of harm done to it."""
    rng = np.random.default_rng(seed)
    V, F = BASES[rng.integers(len(BASES))](rng)
    V, F = np.array(V, dtype=float), np.array(F, dtype=np.int64).reshape(-1, 3)
    with np.errstate(invalid="ignore", over="ignore"):  # one harm may work on another's NaN
        for _ in range(rng.integers(4)):
            V, F = HARMS[rng.integers(len(HARMS))](rng, V, F)
    return V, F


def _disk(rng: np.random.Generator) -> Mesh:
    V, F = flat_disk(int(rng.integers(16, 200)), int(rng.integers(1000)))
    return V, F


def _blob(rng: np.random.Generator) -> Mesh:
    """Random points, the triangles with long edges left out: ears, bow-ties and holes happen."""
    points = rng.random((int(rng.integers(4, 120)), 2))
    F = Delaunay(points).simplices
    longest = np.max([np.linalg.norm(points[F[:, k]] - points[F[:, k - 1]], axis=1) for k in range(3)], axis=0)
    F = F[longest < rng.uniform(0.15, 1.5)]
    if not len(F):
        F = np.array([[0, 1, 2]])
    a, b, c = points[F[:, 0]], points[F[:, 1]], points[F[:, 2]]
    turned = np.linalg.det(np.stack((b - a, c - a), axis=1)) < 0
    F[turned] = F[turned][:, ::-1]
    used, F = np.unique(F, return_inverse=True)
    return np.column_stack((points[used], np.zeros(len(used)))), F.reshape(-1, 3)


def _grid(rng: np.random.Generator, closed: tuple[bool, bool] = (False, False)) -> Mesh:
    """A grid of quadrangles cut in two; closed in one direction it is a tube, in both a torus."""
    nu, nv = int(rng.integers(3, 30)), int(rng.integers(3, 12))
    number = np.arange(nu * nv).reshape(nu, nv)
    rows = np.arange(nu if closed[0] else nu - 1)[:, None]
    columns = np.arange(nv if closed[1] else nv - 1)[None, :]
    a, b = number[rows, columns], number[(rows + 1) % nu, columns]
    c, d = number[(rows + 1) % nu, (columns + 1) % nv], number[rows, (columns + 1) % nv]
    F = np.concatenate((np.stack((a, b, c), -1).reshape(-1, 3), np.stack((a, c, d), -1).reshape(-1, 3)))
    u, v = (x.reshape(-1).astype(float) for x in np.meshgrid(np.arange(nu), np.arange(nv), indexing="ij"))
    if not closed[0]:
        return np.column_stack((u, v * rng.uniform(0.05, 3.0), np.zeros(nu * nv))), F
    turn = 2 * np.pi * u / nu
    if not closed[1]:
        return np.column_stack((np.cos(turn), np.sin(turn), v * rng.uniform(0.05, 3.0))), F
    ring = 2 + np.cos(2 * np.pi * v / nv)
    return np.column_stack((ring * np.cos(turn), ring * np.sin(turn), np.sin(2 * np.pi * v / nv))), F


def _tube(rng: np.random.Generator) -> Mesh:
    return _grid(rng, (True, False))


def _closed_tube(rng: np.random.Generator) -> Mesh:
    """A finger: a tube shut at one end."""
    V, F = _grid(rng, (True, False))
    top = V[:, 2].max()
    rim = np.flatnonzero(V[:, 2] == top)
    rim = rim[np.argsort(np.arctan2(V[rim, 1], V[rim, 0]))]
    lid = np.column_stack((rim, np.roll(rim, -1), np.full(len(rim), len(V))))
    return np.vstack((V, [0.0, 0.0, top + 0.3])), np.vstack((F, lid))


def _torus(rng: np.random.Generator) -> Mesh:
    return _grid(rng, (True, True))


def _fan(rng: np.random.Generator) -> Mesh:
    n = int(rng.integers(1, 40))
    turn = np.linspace(0, rng.uniform(0.1, 2 * np.pi), n + 1)
    V = np.vstack(([0.0, 0.0, 0.0], np.column_stack((np.cos(turn), np.sin(turn), 0 * turn))))
    return V, np.column_stack((np.zeros(n, dtype=int), np.arange(1, n + 1), np.arange(2, n + 2)))


def _soup(rng: np.random.Generator) -> Mesh:
    n = int(rng.integers(3, 60))
    return rng.random((n, 3)), rng.integers(0, n, (int(rng.integers(1, 80)), 3))


BASES = (_disk, _disk, _disk, _blob, _blob, _blob, _grid, _grid, _tube, _closed_tube, _closed_tube, _torus, _fan, _soup)


def _rough(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    return V + np.ptp(V) * 10.0 ** rng.uniform(-6, 1) * rng.normal(size=V.shape), F


def _stretched(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    return V * 10.0 ** rng.uniform(-6, 6, 3), F


def _scaled(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    return V * 10.0 ** rng.uniform(-150, 150), F


def _shifted(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    return V + 10.0 ** rng.uniform(0, 12) * rng.normal(size=3), F


def _pinched(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    """Some vertices moved onto a neighbour: coincident positions."""
    V = V.copy()
    for face in F[rng.integers(len(F), size=rng.integers(1, 8))]:
        V[face[0]] = V[face[1]]
    return V, F


def _slivers(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    """Some faces brought to almost or exactly no area."""
    V = V.copy()
    for a, b, c in F[rng.integers(len(F), size=rng.integers(1, 20))]:
        middle = 0.5 * (V[a] + V[b])
        V[c] = middle + rng.choice([0.0, 1e-15, 1e-9, 1e-4]) * (V[c] - middle)
    return V, F


def _spike(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    V = V.copy()
    V[rng.integers(len(V))] += 10.0 ** rng.uniform(0, 6) * np.ptp(V) * rng.normal(size=3)
    return V, F


def _torn(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    """Some faces taken out: holes, bow-ties, pieces."""
    keep = rng.random(len(F)) > rng.choice([0.02, 0.2])
    if not keep.any():
        keep[0] = True
    return V, F[keep]


def _clean(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    """Unreferenced vertices taken out."""
    used, numbered = np.unique(F, return_inverse=True)
    return V[used], numbered.reshape(-1, 3)


def _turned(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    F = F.copy()
    k = rng.integers(len(F))
    F[k] = F[k][::-1]
    return V, F


def _doubled(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    return V, np.vstack((F, F[rng.integers(len(F))][rng.permutation(3)]))


def _glued(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    """One vertex replaced by another."""
    a, b = rng.integers(len(V), size=2)
    return V, np.where(F == a, b, F)


def _holed(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    """The star of a vertex taken out."""
    keep = (F[rng.integers(len(F))][0] != F).all(axis=1)
    return (V, F[keep]) if keep.any() else (V, F)


def _unsound(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    V = V.copy()
    V[rng.integers(len(V)), rng.integers(3)] = rng.choice([np.nan, np.inf, -np.inf])
    return V, F


def _relabelled(rng: np.random.Generator, V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    order = rng.permutation(len(V))
    place = np.argsort(order)
    return V[order], place[F][rng.permutation(len(F))]


HARMS = (
    _rough, _rough, _stretched, _stretched, _scaled, _shifted, _pinched, _slivers, _slivers, _spike, _torn, _clean,
    _turned, _doubled, _glued, _holed, _unsound, _relabelled,
)  # fmt: skip
