"""One map, measured, and the same mesh changed in ways that must not matter."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import conformal_uv as cuv

from ..speed.quality import boundary_vertices
from .rows import ChangeRow, MapRow
from .shapes import Mesh

__all__ = ["METHODS", "changed", "is_disk", "measured", "unchanged"]

ALWAYS = {"method": "auto", "repair": "always"}
METHODS: dict[str, dict[str, dict[str, str]]] = {
    "disk": {**{name: {"method": name} for name in ("linear", "newton", "auto")}, "always": ALWAYS},
    "sphere": {**{name: {"method": name} for name in ("linear", "schwarz", "newton", "auto")}, "always": ALWAYS},
}
REPEATS, ENOUGH = 3, 2.0  # of a map, until it took so many seconds in all


def is_disk(F: NDArray[np.int64]) -> bool:
    """Whether the surface has a boundary."""
    return len(boundary_vertices(F)) > 0


def mapped(mesh: Mesh, options: dict[str, str], limit: float) -> tuple[Any, NDArray[np.float64]]:
    """The result and its positions.

    Raises
    ------
    CancelledError
        It took longer than the limit.
    """
    end = time.perf_counter() + limit
    call = cuv.disk_map if is_disk(mesh[1]) else cuv.sphere_map
    result: Any = call(*mesh, callback=lambda stage, fraction: time.perf_counter() < end, **options)
    return result, result.uv if hasattr(result, "uv") else result.xyz


def measured(name: str, mesh: Mesh, method: str, limit: float) -> MapRow:
    """Map by a method of METHODS and tell."""
    shape = "disk" if is_disk(mesh[1]) else "sphere"
    about = {"mesh": name, "shape": shape, "vertices": len(mesh[0]), "method": method}
    seconds: list[float] = []
    while len(seconds) < REPEATS and sum(seconds) < ENOUGH:
        start = time.process_time()  # others may use the machine
        try:
            result, image = mapped(mesh, METHODS[shape][method], limit)
        except Exception as error:  # whatever it is, a row tells of it
            return MapRow(**about, error=type(error).__name__)
        seconds.append(time.process_time() - start)
    error = np.abs(result.distortion.angle_error)
    rim = image[result.boundary] if shape == "disk" else image
    return MapRow(
        **about,
        mean=float(error.mean()),
        rms=float(np.sqrt((error * error).mean())),
        largest=float(error.max()),
        folds=len(result.flipped),
        off=float(np.abs(np.linalg.norm(rim, axis=1) - 1.0).max()),
        seconds=min(seconds),
        chosen=str(result.method),
        status=str(result.status),
    )


def changed(mesh: Mesh) -> Iterator[tuple[str, Mesh, NDArray[np.int64]]]:
    """Ten similar or renumbered meshes, each with the new number of every vertex."""
    V, F = mesh
    n, rng = len(V), np.random.default_rng(5)
    same, size = np.arange(n), float(np.ptp(V, axis=0).max())
    turns = Rotation.random(3, random_state=3).as_matrix()
    orders = [rng.permutation(n) for _ in range(3)]
    shuffled = rng.permutation(len(F))
    corner = (np.arange(3) + rng.integers(0, 3, len(F))[:, None]) % 3
    yield "rotation", (V @ turns[0].T, F), same
    yield "second rotation", (V @ turns[1].T, F), same
    yield "scale 1.1", (V * 1.1, F), same
    yield "scale 1e-3", (V * 1e-3, F), same
    yield "scale 1e5", (V * 1e5, F), same
    yield "shift", (V + size * np.array([1.3, -0.7, 2.1]), F), same
    for told, order in zip(("vertices renumbered", "vertices renumbered again"), orders, strict=False):
        yield told, _renumbered(V, F, order), order
    yield "faces in another order, corners turned", (V, np.take_along_axis(F, corner, axis=1)[shuffled]), same
    W, G = _renumbered(V * 0.7 @ turns[2].T + 0.4 * size, F[shuffled], orders[2])
    yield "all of these", (W, G), orders[2]


def _renumbered(V: NDArray[np.float64], F: NDArray[np.int64], order: NDArray[np.int64]) -> Mesh:
    """With vertex i called order[i]."""
    W = np.empty_like(V)
    W[order] = V
    return W, order[F]


def unchanged(name: str, mesh: Mesh, limit: float) -> Iterator[ChangeRow]:
    """The default map of the changed meshes, brought back to the mesh and measured there."""
    before, error = _default(mesh, mesh, np.arange(len(mesh[0])), limit)
    for told, other, number in changed(mesh):
        after, found = _default(mesh, other, number, limit)
        yield ChangeRow(name, told, before, after, abs(found - error))


def _default(mesh: Mesh, other: Mesh, number: NDArray[np.int64], limit: float) -> tuple[str, float]:
    """Method, or what was raised, and mean angle error on the first mesh."""
    try:
        result, image = mapped(other, {}, limit)
    except Exception as error:  # whatever it is, a row tells of it
        return type(error).__name__, 0.0
    return str(result.method), float(cuv.distortion(*mesh, image[number]).angle_mean)
