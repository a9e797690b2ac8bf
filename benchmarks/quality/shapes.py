"""Disks and closed surfaces by formula, and disks cut out of closed surfaces."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import ConvexHull

TESTS = Path(__file__).resolve().parents[2] / "tests"
if str(TESTS) not in sys.path:
    sys.path.append(str(TESTS))  # whose meshes by hand are mapped as well

from meshes_closed import icosphere  # noqa: E402

__all__ = ["above_plane", "dumbbell", "ellipsoid", "hull", "limbs", "rod", "twisted", "without_face", "without_star"]

Real = NDArray[np.float64]
Mesh = tuple[Real, NDArray[np.int64]]


def ellipsoid(level: int, *axes: float) -> Mesh:
    """An icosphere, stretched."""
    V, F = icosphere(level)
    return V * np.array(axes), F


def limbs(level: int, length: float, count: int = 1) -> Mesh:
    """A sphere with limbs that many radii long, on which any map to the sphere crowds."""
    V, F = icosphere(level)
    x = V.copy()
    for k in range(count):
        axis = np.eye(3)[k % 3] * (1.0 if k < 3 else -1.0)
        along = np.maximum(V @ axis - 0.8, 0.0)[:, None]
        across = V - (V @ axis)[:, None] * axis
        x += 5.0 * length * along * axis - 1.5 * along * across
    return x, F


def dumbbell(level: int, waist: float) -> Mesh:
    """Two balls and a waist of that radius."""
    V, F = icosphere(level)
    thin = 1.0 - (1.0 - waist) * np.exp(-((V[:, 2:] / 0.4) ** 2))
    return V * np.hstack((thin, thin, np.full_like(thin, 3.0))), F


def rod(sides: int, rings: int, length: float) -> Mesh:
    """A prism with even sides and flat ends, coarse where `sides` is small."""
    t = 2 * np.pi * np.arange(sides) / sides
    circle = np.column_stack((np.cos(t), np.sin(t)))
    V = np.column_stack((np.tile(circle, (rings, 1)), np.repeat(np.linspace(0, length, rings), sides)))
    a = np.arange((rings - 1) * sides)
    b = a + 1 - sides * (a % sides == sides - 1)
    low, high = np.arange(sides), np.arange((rings - 1) * sides, rings * sides)
    lids = (
        np.column_stack((np.roll(low, -1), low, np.full(sides, len(V)))),
        np.column_stack((high, np.roll(high, -1), np.full(sides, len(V) + 1))),
    )
    F = np.concatenate((np.column_stack((a, b, b + sides)), np.column_stack((a, b + sides, a + sides)), *lids))
    return np.vstack((V, [0, 0, 0], [0, 0, length])), F


def hull(count: int, seed: int, *axes: float) -> Mesh:
    """The convex hull of random points of a sphere, stretched."""
    P = np.random.default_rng(seed).normal(size=(count, 3))
    P /= np.linalg.norm(P, axis=1, keepdims=True)
    F = ConvexHull(P).simplices.astype(np.int64)
    inward = np.linalg.det(P[F]) < 0
    F[inward] = F[inward][:, ::-1]
    return P * np.array(axes or (1.0, 1.0, 1.0)), F


def twisted(mesh: Mesh, turns: float) -> Mesh:
    """A ribbon along x, wound around that axis."""
    (x, y, _), F = mesh[0].T, mesh[1]
    t = 2 * np.pi * turns * x / np.ptp(x)
    y = y - y.mean()
    return np.column_stack((x, y * np.cos(t), y * np.sin(t))), F


def compact(V: Real, F: NDArray[np.int64]) -> Mesh:
    """Without the vertices that no face uses."""
    used, F = np.unique(F, return_inverse=True)
    return V[used], F.reshape(-1, 3)


def without_star(mesh: Mesh, vertex: int = 0) -> Mesh:
    """A closed surface with a hole the size of a vertex's star."""
    return compact(mesh[0], mesh[1][~(mesh[1] == vertex).any(axis=1)])


def without_face(mesh: Mesh, face: int = 0) -> Mesh:
    """A closed surface with a hole of three vertices."""
    return compact(mesh[0], np.delete(mesh[1], face, axis=0))


def above_plane(mesh: Mesh) -> Mesh:
    """The largest part of a closed surface on one side of a plane through its middle, where that is a disk.

    Raises
    ------
    ValueError
        None of the three coordinate planes leaves a disk on either side.
    """
    V, F = mesh
    middle = V[F].mean(axis=1)
    for axis in np.argsort(-np.ptp(V, axis=0)):
        for sense in (1.0, -1.0):
            side = sense * (middle[:, axis] - np.median(V[:, axis]))
            W, G = compact(V, _largest(F[side > 0]))
            edges = np.unique(np.sort(np.concatenate((G[:, :2], G[:, 1:], G[:, ::2])), axis=1), axis=0)
            if len(W) - len(edges) + len(G) == 1:
                return W, G
    raise ValueError("no plane cuts a disk off")


def _largest(F: NDArray[np.int64]) -> NDArray[np.int64]:
    """The faces of the largest part that hangs together by edges."""
    face = np.tile(np.arange(len(F)), 3)
    sides = np.sort(np.concatenate((F[:, :2], F[:, 1:], F[:, ::2])), axis=1)
    _, edge = np.unique(sides, axis=0, return_inverse=True)
    touch = coo_array((np.ones(len(face)), (face, edge.reshape(-1)))).tocsr()
    _, part = connected_components(touch @ touch.T, directed=False)
    return F[part == np.bincount(part).argmax()]
