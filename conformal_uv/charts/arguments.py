"""What a caller passes to unwrap, made into arrays of one kind and checked before anything is computed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import MeshError, OptionError, listed
from ..mesh.arrays import vertex_array
from ..mesh.polygon_sides import edge_keys, following_corners
from ..mesh.polygons import PolygonMesh

__all__ = ["check_seams", "polygon_mesh", "seam_pairs", "selected_polygons", "used_vertices", "vertex_list"]

Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

Polygons = PolygonMesh | ArrayLike | Sequence[Sequence[int]]


def polygon_mesh(V: ArrayLike | None, polygons: Polygons) -> tuple[PolygonMesh, Bools]:
    """Vertices and polygons as one mesh, and which vertices are finite, (n,); the others are put at 0.

    Raises
    ------
    MeshError
        Shapes, types, or indices outside the vertices.
    """
    if isinstance(polygons, PolygonMesh):
        given, corners, starts = polygons.V if V is None else V, polygons.corners, polygons.starts
    else:
        if V is None:
            raise MeshError("V is missing; only a PolygonMesh brings its own vertices.")
        given = V
        corners, starts = _corners(polygons)
    vertices, finite = _positions(given)
    outside = np.flatnonzero((corners < 0) | (corners >= len(vertices)))
    if len(outside):
        bad = np.unique(np.searchsorted(starts, outside, side="right") - 1)
        raise MeshError(
            f"{len(bad)} polygons name vertices outside 0 .. {len(vertices) - 1}: polygons {listed(bad)}.", bad
        )
    if len(starts) < 2:
        raise MeshError(f"The mesh is empty ({len(vertices)} vertices, no polygons); there is nothing to map.")
    return PolygonMesh(vertices, corners, starts), finite


def _positions(V: ArrayLike) -> tuple[NDArray[np.float64], Bools]:
    raw = np.asarray(V)
    if raw.dtype.kind != "f" or raw.ndim != 2:
        vertices = vertex_array(raw)
        return vertices, np.ones(len(vertices), dtype=bool)
    finite = np.isfinite(raw).all(axis=1)
    if not finite.all():
        raw = np.where(finite[:, None], raw, 0.0)
    return vertex_array(raw), finite


def _corners(polygons: ArrayLike | Sequence[Sequence[int]]) -> tuple[Ints, Ints]:
    """Corners and starts of an (m, k) array or of a ragged list of vertex lists."""
    if isinstance(polygons, np.ndarray) and polygons.dtype != object:
        if polygons.ndim != 2:
            raise MeshError(f"polygons has shape {polygons.shape}; pass (m, k) vertex indices or a list of lists.")
        starts = np.arange(len(polygons) + 1) * polygons.shape[1]
        return _whole_numbers("polygons", polygons.reshape(-1)), starts
    try:
        rows: list[Any] = list(polygons)  # type: ignore[arg-type]
        sizes = np.fromiter(map(len, rows), dtype=np.int64, count=len(rows))
        flat = np.asarray(list(chain.from_iterable(rows)))
    except (TypeError, ValueError) as error:
        raise MeshError(f"polygons is not a list of vertex lists ({error}).") from error
    starts = np.concatenate((np.zeros(1, dtype=np.int64), np.cumsum(sizes)))
    return _whole_numbers("polygons", flat.reshape(-1)), starts


def _whole_numbers(name: str, raw: NDArray[Any]) -> Ints:
    if raw.size == 0:
        return np.empty(raw.shape, dtype=np.int64)
    if raw.dtype.kind in "iu":
        return raw.astype(np.int64, copy=False)
    if raw.dtype.kind == "f" and np.isfinite(raw).all() and (raw == np.rint(raw)).all() and np.abs(raw).max() < 2**62:
        return raw.astype(np.int64)
    raise MeshError(f"{name} holds {raw.dtype}, not vertex indices.")


def selected_polygons(selection: ArrayLike | None, mesh: PolygonMesh) -> Ints:
    """Indices of the selected polygons, increasing.

    Raises
    ------
    OptionError
        Neither a mask nor indices, or nothing selected.
    MeshError
        A selected polygon has fewer than three corners.
    """
    p = len(mesh.starts) - 1
    if selection is None:
        chosen = np.arange(p)
    else:
        raw = np.asarray(selection)
        if raw.dtype == bool and raw.shape == (p,):
            chosen = np.flatnonzero(raw)
        elif raw.ndim == 1 and (raw.dtype.kind in "iu" or raw.size == 0):
            chosen = np.unique(raw).astype(np.int64)
        else:
            raise OptionError(f"selection is {raw.dtype} {raw.shape}; pass a mask ({p},) or polygon indices.")
        if len(chosen) and not (chosen[0] >= 0 and chosen[-1] < p):
            raise OptionError(f"selection names polygons outside 0 .. {p - 1}.")
    if not len(chosen):
        raise OptionError("No face is selected; there is nothing to map.")
    short = chosen[np.diff(mesh.starts)[chosen] < 3]
    if len(short):
        raise MeshError(f"{len(short)} polygons have fewer than 3 corners: polygons {listed(short)}.", short)
    return chosen


def used_vertices(mesh: PolygonMesh, polygons: Ints) -> Bools:
    """Vertices of some of the polygons, (n,)."""
    chosen = np.zeros(len(mesh.sizes), dtype=bool)
    chosen[polygons] = True
    used = np.zeros(len(mesh.V), dtype=bool)
    used[mesh.corners[np.repeat(chosen, mesh.sizes)]] = True
    return used


def seam_pairs(seams: ArrayLike | None) -> Ints:
    """Seams as (s, 2) vertex pairs.

    Raises
    ------
    OptionError
        Not pairs of integers.
    """
    if seams is None:
        return np.empty((0, 2), dtype=np.int64)
    try:
        raw = np.asarray(seams if isinstance(seams, np.ndarray) else list(seams))  # type: ignore[arg-type]
    except (TypeError, ValueError) as error:
        raise OptionError(f"seams are not an array ({error}); pass (s, 2) vertex pairs.") from error
    if raw.size == 0:
        return np.empty((0, 2), dtype=np.int64)
    if raw.ndim != 2 or raw.shape[1] != 2 or raw.dtype.kind not in "iu":
        raise OptionError(f"seams are {raw.dtype} {raw.shape}; pass (s, 2) vertex pairs.")
    return raw.astype(np.int64)


def check_seams(missing: Ints, mesh: PolygonMesh) -> None:
    """Raise OptionError where one of the pairs `missing` (s, 2) is not even an edge of the whole mesh."""
    n = len(mesh.V)
    sides = np.unique(edge_keys(mesh.corners, mesh.corners[following_corners(mesh)], n))
    inside = ((missing >= 0) & (missing < n)).all(axis=1)
    keys = edge_keys(missing[:, 0], missing[:, 1], n)
    found = inside & (sides[np.minimum(np.searchsorted(sides, keys), len(sides) - 1)] == keys)
    if not found.all():
        bad = missing[~found]
        named = ", ".join(f"({a}, {b})" for a, b in bad[:8])
        raise OptionError(
            f"{len(bad)} seams are not edges of the mesh: {named}{' ...' if len(bad) > 8 else ''}.", bad.reshape(-1)
        )


def vertex_list(name: str, value: int | Iterable[Any] | None, used: Bools) -> Ints:
    """One vertex, several, or several lists of them, as a flat array.

    Raises
    ------
    OptionError
        Not vertex indices, or vertices of no selected face.
    """
    if value is None:
        return np.empty(0, dtype=np.int64)
    try:
        lists = [value] if isinstance(value, int | np.integer) else list(value)
        raw = np.concatenate([np.ravel(item) for item in lists] or [np.empty(0)])
    except (TypeError, ValueError) as error:
        raise OptionError(f"{name} is {value!r}; pass vertex indices.") from error
    if raw.size == 0:
        return np.empty(0, dtype=np.int64)
    if raw.dtype.kind not in "iu":
        raise OptionError(f"{name} is {value!r}; pass vertex indices.")
    vertices = raw.reshape(-1).astype(np.int64)
    inside = (vertices >= 0) & (vertices < len(used))
    bad = vertices[~inside | ~used[np.where(inside, vertices, 0)]]
    if len(bad):
        raise OptionError(f"{name}: vertices {listed(bad)} belong to no selected face.", bad)
    return vertices
