"""Vertices and faces as a user brings them, made into arrays of one kind."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import MeshError
from . import refusals

__all__ = [
    "check_referenced",
    "face_array",
    "face_indices",
    "on_one_line",
    "scaled",
    "scaled_each",
    "squared_units",
    "vertex_array",
    "vertex_numbers",
]

MOST_VERTICES = 2**31 - 1
FEW = 100  # vertices, which nearly always tell already that they are on no line


def vertex_array(V: ArrayLike) -> NDArray[np.float64]:
    """Vertices as a (n, 3) float64 array in C order; two columns are taken to lie in the plane z = 0.

    Raises
    ------
    MeshError
        Not an array of numbers with three (or two) columns.
    NonFiniteError
        A coordinate is NaN or infinite.
    """
    array = vertex_numbers(V)
    with np.errstate(invalid="ignore", over="ignore"):
        total = array.sum()  # one pass; the indices are looked for only when there are some
    if not np.isfinite(total):
        bad = np.flatnonzero(~np.isfinite(array).all(axis=1))
        if len(bad):
            raise refusals.non_finite(bad, len(array))
    return array


def vertex_numbers(V: ArrayLike, rows: int | None = None) -> NDArray[np.float64]:
    """The same, finite or not; where they are some rows of more, errors tell of `rows`.

    Raises
    ------
    MeshError
    """
    try:
        raw = np.asarray(V)
        if raw.dtype.kind not in "biuf" and raw.size:
            raise TypeError("complex numbers" if raw.dtype.kind == "c" else f"dtype {raw.dtype}")
        array = np.ascontiguousarray(raw, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise MeshError(f"V is not an array of numbers ({error}); pass vertices as (n, 3) floats.") from error
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise MeshError(f"V has shape {_whole_shape(array, rows)}; pass vertices as (n, 3) floats.")
    if array.shape[1] == 2:
        array = np.column_stack((array, np.zeros(len(array))))
    return array


def face_array(F: ArrayLike, n: int) -> NDArray[np.int32]:
    """Triangles as a (3, m) int32 array, a row for each corner.

    Parameters
    ----------
    F : (m, 3) integers
        Vertex indices, 0-based. Floats are taken where they are whole numbers.
    n : int
        Number of vertices.

    Raises
    ------
    MeshError
        Not integers with three columns, no faces, or an index outside 0 .. n - 1.
    DegenerateFaceError
        A face repeats a vertex.
    """
    faces = face_indices(F)
    if not len(faces) or not n:
        raise refusals.empty(n, len(faces))
    if n > MOST_VERTICES or len(faces) > MOST_VERTICES // 3:
        raise MeshError(f"{n} vertices and {len(faces)} faces are more than 32-bit indices can number.")
    if faces.min() < 0 or faces.max() >= n:
        bad = np.flatnonzero(((faces < 0) | (faces >= n)).any(axis=1))
        raise refusals.outside(bad, n, int(faces.min()), int(faces.max()))
    corners = np.empty((3, len(faces)), dtype=np.int32)
    corners[...] = faces.T
    a, b, c = corners
    repeated = (a == b) | (b == c) | (c == a)
    if repeated.any():
        raise refusals.repeated(np.flatnonzero(repeated))
    return corners


def face_indices(F: ArrayLike, rows: int | None = None) -> NDArray[np.integer]:
    """Triangles as integers (m, 3), whatever they are; `rows` as in `vertex_numbers`.

    Raises
    ------
    MeshError
    """
    faces = _integers(F)
    if faces.ndim != 2 or faces.shape[1] != 3:
        raise refusals.faces_shape(_whole_shape(faces, rows))
    return faces


def _whole_shape(array: NDArray[Any], rows: int | None) -> tuple[int, ...]:
    return array.shape if rows is None else (rows, *array.shape[1:])


def _integers(F: ArrayLike) -> NDArray[np.integer]:
    try:
        raw = np.asarray(F)
    except ValueError as error:
        raise MeshError(f"F is not an array ({error}); pass triangles as (m, 3) vertex indices.") from error
    if raw.dtype.kind in "iu":
        return raw
    if raw.dtype.kind == "f" and np.isfinite(raw).all() and np.all(raw == np.rint(raw)):
        if raw.size == 0 or np.abs(raw).max() < 2.0**62:
            return raw.astype(np.int64)
    raise MeshError(f"F holds {raw.dtype}, not integers; pass triangles as (m, 3) vertex indices.")


def check_referenced(corners: NDArray[np.int32], n: int) -> None:
    """Raise UnreferencedVertexError when a vertex belongs to no face."""
    used = np.zeros(n, dtype=bool)
    used[corners] = True
    if not used.all():
        raise refusals.unreferenced(np.flatnonzero(~used), n)


def scaled(V: NDArray[np.float64]) -> tuple[NDArray[np.float64], float]:
    """V over a power of two, and that power: an exact operation that keeps squares from overflowing."""
    _, exponent = np.frexp(max(V.max(), -V.min()))
    exponent = min(exponent, 1023)  # 2^1024 is no double
    return np.ldexp(V, -exponent), float(np.ldexp(1.0, exponent))


def scaled_each(
    V: NDArray[np.float64], owner: NDArray[np.int64], count: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """As `scaled`, each of so many meshes for itself, `owner` (n,) being that of each vertex; the units (count,)."""
    largest = np.zeros(count)
    np.maximum.at(largest, owner, np.abs(V).max(axis=1))
    _, exponent = np.frexp(np.where(np.isfinite(largest), largest, 1.0))
    exponent = np.minimum(exponent, 1023)
    return np.ldexp(V, -exponent[owner][:, None]), np.ldexp(1.0, exponent)


def squared_units(areas: NDArray[np.float64], unit: float | NDArray[np.float64]) -> NDArray[np.float64]:
    """Areas in units squared; infinite where they are too large for doubles."""
    with np.errstate(over="ignore", under="ignore"):
        return areas * unit * unit


def on_one_line(V: NDArray[np.float64]) -> bool:
    """Whether points lie on one line, each coordinate being known to its own rounding.

    Seen along each axis, the vector product of a difference of points and the longest one is wrong by a few eps times
    the sizes of the two coordinates; a mesh that is only very thin, or has one very long spike, is wider than that.
    `V` is scaled.
    """
    if not _on_line(V[:FEW], np.ones(3)):
        return False
    return _on_line(V, np.abs(V).max(axis=0))


def _on_line(V: NDArray[np.float64], size: NDArray[np.float64]) -> bool:
    from_first = V - V[0]
    farthest = from_first[np.argmax(np.abs(from_first).max(axis=1))]
    for i, j in ((0, 1), (1, 2), (2, 0)):
        across = from_first[:, i] * farthest[j] - from_first[:, j] * farthest[i]
        rounding = 8.0 * np.finfo(np.float64).eps * (size[i] * abs(farthest[j]) + size[j] * abs(farthest[i]))
        if np.abs(across).max() > rounding:
            return False
    return True
