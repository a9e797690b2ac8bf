"""Texture coordinates of polygon corners: which faces have them, and which corners share them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import NonFiniteError, OptionError, listed
from ..mesh.polygons import PolygonMesh
from .mesh_file import MeshFile

__all__ = ["checked_corner_uv", "filled_corner_uv", "mapped_faces", "shared_uv", "split_at_seams", "vertex_uv"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

BLOCK = 1 << 16  # corners compared together


def checked_corner_uv(mesh: PolygonMesh, corner_uv: Floats) -> Floats:
    """``corner_uv`` as (k, 2) float64.

    Raises
    ------
    OptionError
        It has not one row of two numbers for each corner.
    NonFiniteError
        A number is infinite (NaN is a corner without texture coordinates).
    """
    uv = np.asarray(corner_uv, dtype=np.float64)
    if uv.shape != (len(mesh.corners), 2):
        raise OptionError(
            f"corner_uv has the shape {uv.shape}; the mesh has {len(mesh.corners)} corners, "
            f"so it must be ({len(mesh.corners)}, 2)"
        )
    if np.isinf(uv).any():
        infinite = np.flatnonzero(np.isinf(uv).any(axis=1))
        raise NonFiniteError(
            f"infinite texture coordinates at corners {listed(infinite)}; use NaN for a corner that has none", infinite
        )
    return uv


def mapped_faces(mesh: PolygonMesh, uv: Floats) -> NDArray[np.bool_]:
    """The faces that have texture coordinates at every corner, (p,)."""
    if not _any_nan(uv):
        return np.ones(len(mesh.starts) - 1, dtype=bool)
    nan = np.isnan(uv[:, 0]) | np.isnan(uv[:, 1])
    missing = np.concatenate([np.zeros(1, np.int64), np.cumsum(nan)])
    return np.asarray(missing[mesh.starts[1:]] == missing[mesh.starts[:-1]])


def _any_nan(uv: Floats) -> bool:
    """In one pass without an array of flags: the least of numbers among which is NaN is NaN."""
    return bool(np.isnan(uv.min(initial=0.0)))


def filled_corner_uv(mesh: PolygonMesh, uv: Floats, old: Floats | None) -> Floats:
    """``uv``; on the faces that it does not map whole, ``old`` (NaN where there is none)."""
    faces = mapped_faces(mesh, uv)
    if faces.all():
        return uv
    mapped = np.repeat(faces, mesh.sizes)
    return np.where(mapped[:, None], uv, np.nan if old is None else old)


def shared_uv(vertex: Ints, uv: Floats) -> tuple[Ints, Ints]:
    """Number the different texture coordinates at each vertex.

    Returns
    -------
    number : (c,) int64
        One number for the corners of a vertex that have equal coordinates, ascending with the vertex.
    example : (t,) int64
        A corner for each number.
    """
    first = np.full(int(vertex.max(initial=-1)) + 1, -1, np.int64)
    first[vertex[::-1]] = np.arange(len(vertex))[::-1]
    example_of = first[vertex]
    seam = np.zeros(len(first), dtype=bool)
    seam[vertex[(uv != uv[example_of]).any(axis=1)]] = True
    at = np.flatnonzero(seam[vertex])
    at = at[np.lexsort((uv[at, 1], uv[at, 0], vertex[at]))]  # stable: equal corners stay in file order
    new = np.ones(len(at), dtype=bool)
    new[1:] = (vertex[at[1:]] != vertex[at[:-1]]) | (uv[at[1:]] != uv[at[:-1]]).any(axis=1)
    example_of[at] = at[new][np.cumsum(new) - 1]
    is_example = np.zeros(len(vertex), dtype=bool)
    is_example[example_of] = True
    example = np.flatnonzero(is_example)
    example = example[np.lexsort((example, vertex[example]))]
    number = np.empty(len(vertex), np.int64)
    number[example] = np.arange(len(example))
    return number[example_of], example


def vertex_uv(mesh: PolygonMesh, uv: Floats) -> Floats | None:
    """(n, 2) if every vertex has corners and all of them the same coordinates, else None."""
    if _any_nan(uv):
        return None
    example = np.full(len(mesh.V), -1, np.int64)
    example[mesh.corners] = np.arange(len(mesh.corners))
    if example.min(initial=0) < 0:
        return None
    each = uv[example]
    for begin in range(0, len(uv), BLOCK):
        some = slice(begin, begin + BLOCK)
        if not np.array_equal(each.take(mesh.corners[some], axis=0), uv[some]):
            return None
    return each


def split_at_seams(source: MeshFile, uv: Floats) -> tuple[MeshFile, Floats]:
    """The mesh with a vertex for every texture coordinate of each vertex, and the coordinates of its corners.

    Corners without coordinates get (0, 0), since a vertex can not be without. Vertices of no face are left out.
    """
    mesh = source.mesh
    filled = np.nan_to_num(filled_corner_uv(mesh, uv, source.corner_uv), nan=0.0)
    number, example = shared_uv(mesh.corners, filled)
    original = mesh.corners[example]
    split = PolygonMesh(mesh.V[original], number, mesh.starts)
    return MeshFile(source.path, split, original_vertex=original), filled
