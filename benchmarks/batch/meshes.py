"""A cohort made by formula: surfaces of four families in three formats, some of them broken in ten ways."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from conformal_uv import PolygonMesh, samples
from conformal_uv.files import MeshFile, write_mesh

__all__ = ["BROKEN", "write_broken", "write_cohort", "write_triangles"]

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]

FAMILIES: tuple[Callable[..., Mesh], ...] = (samples.mask, samples.terrain, samples.spherical_cap, samples.flat_disk)
SUFFIXES = (".ply", ".obj", ".npz")


def write_triangles(path: Path, V: NDArray[np.float64], F: NDArray[np.integer]) -> None:
    """Write a triangle mesh without texture coordinates."""
    corners = np.asarray(F, dtype=np.int64).reshape(-1)
    mesh = PolygonMesh(np.asarray(V, dtype=np.float64), corners, np.arange(0, len(corners) + 1, 3, dtype=np.int64))
    write_mesh(path, MeshFile(path, mesh), corner_uv=np.full((len(corners), 2), np.nan))


def _not_a_number(V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    V = V.copy()
    V[len(V) // 2] = np.nan
    return V, F


def _on_a_line(V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    return V * [1.0, 0.0, 0.0], F


def _face_twice(V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    return V, np.vstack((F, F[:1]))


def _third_face(V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    a, b = F[len(F) // 2, :2]
    return np.vstack((V, V[a] + [0.0, 0.0, 1.0])), np.vstack((F, [[a, b, len(V)]]))


def _touching(V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    beyond = V[:1] + [[2.0, 0.0, 0.0], [2.0, 1.0, 0.0]]
    return np.vstack((V, beyond)), np.vstack((F, [[0, len(V), len(V) + 1]]))


def _turned_face(V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    F = F.copy()
    F[len(F) // 2] = F[len(F) // 2, ::-1]
    return V, F


def _one_sided(V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    count = 40
    turn = np.repeat(2 * np.pi * np.arange(count) / count, 2)
    across = np.tile([-0.3, 0.3], count)
    ring = 1 + across * np.cos(turn / 2)
    band = np.column_stack((ring * np.cos(turn), ring * np.sin(turn), across * np.sin(turn / 2)))
    p = 2 * np.arange(count)
    r, s = np.roll(p, -1), np.roll(p, -1) + 1
    r[-1], s[-1] = 1, 0
    return band, np.concatenate((np.column_stack((p, r, p + 1)), np.column_stack((p + 1, r, s))))


def _closed(V: NDArray[np.float64], F: NDArray[np.int64]) -> Mesh:
    cube = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    sides = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    return cube, np.concatenate((sides[:, :3], sides[:, [0, 2, 3]]))


# What is wrong, and the class of the error that a disk is refused with.
BROKEN: dict[str, tuple[str, Callable[..., Mesh] | None]] = {
    "nan": ("NonFiniteError", _not_a_number),
    "on-a-line": ("DegenerateFaceError", _on_a_line),
    "face-twice": ("DuplicateFaceError", _face_twice),
    "third-face": ("NonManifoldError", _third_face),
    "touching": ("NonManifoldError", _touching),
    "turned-face": ("OrientationError", _turned_face),
    "one-sided": ("OrientationError", _one_sided),
    "closed": ("TopologyError", _closed),
    "beyond": ("FileFormatError", None),
    "cut-off": ("FileFormatError", None),
}


def write_broken(folder: Path, kind: str, name: str, V: NDArray[np.float64], F: NDArray[np.int64]) -> Path:
    """Write the mesh, broken in this way; the file's path."""
    _, change = BROKEN[kind]
    path = folder / f"{name}.ply"
    if change is not None:
        write_triangles(path, *change(V, F))
    elif kind == "beyond":
        path = path.with_suffix(".obj")
        path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 99\n")
    else:
        write_triangles(path, V, F)
        content = path.read_bytes()
        path.write_bytes(content[: len(content) * 2 // 3])
    return path


def write_cohort(folder: Path, count: int, *, least: int, most: int, broken: float, seed: int = 0) -> dict[str, str]:
    """Write so many meshes of `least` to `most` vertices; of the broken ones the error's class by the file's name.

    What is there already is left.
    """
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(seed)
    sizes = np.exp(rng.uniform(np.log(least), np.log(most), count)).astype(int)
    bad = dict(zip(rng.permutation(count)[: round(broken * count)].tolist(), _cycle(), strict=False))
    expected = {}
    for number, n in enumerate(sizes.tolist()):
        name = f"m{number:05d}"
        found = [path for path in folder.glob(f"{name}.*") if path.suffix in SUFFIXES]
        kind = bad.get(number)
        if not found:
            V, F = FAMILIES[number % len(FAMILIES)](n, seed=number)
            V, F = np.asarray(V, dtype=np.float64), np.asarray(F, dtype=np.int64)
            path = folder / f"{name}{SUFFIXES[number // 4 % 3]}"
            found = [path if kind is None else write_broken(folder, kind, name, V, F)]
            if kind is None:
                write_triangles(path, V, F)
        if kind is not None:
            expected[found[0].name] = BROKEN[kind][0]
    return expected


def _cycle():  # type: ignore[no-untyped-def]
    while True:
        yield from BROKEN
