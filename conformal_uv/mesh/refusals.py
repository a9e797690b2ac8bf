"""Why a mesh can not be mapped: the errors, said once for whoever finds the faults, in one array or over many ranks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import (
    DegenerateFaceError,
    DisconnectedError,
    DuplicateFaceError,
    MeshError,
    NonFiniteError,
    NonManifoldError,
    OrientationError,
    TopologyError,
    UnreferencedVertexError,
    listed,
)

__all__ = [
    "areas_lost",
    "closed",
    "crowded_edges",
    "disagreeing",
    "duplicates",
    "empty",
    "faces_shape",
    "handles",
    "no_extent",
    "non_finite",
    "one_sided",
    "outside",
    "pinched",
    "pinched_boundary",
    "repeated",
    "several_loops",
    "several_pieces",
    "unreferenced",
]

Ints = NDArray[np.int64]


def non_finite(bad: Ints, n: int) -> NonFiniteError:
    """Vertices without a place."""
    return NonFiniteError(
        f"{len(bad)} of {n} vertices have a NaN or infinite coordinate: "
        f"{listed(bad)}. Remove them with their faces, or give them positions.",
        bad,
    )


def faces_shape(shape: tuple[int, ...]) -> MeshError:
    """Faces that are no triangles."""
    hint = " Polygons go through unwrap()." if len(shape) == 2 and shape[1] > 3 else ""
    return MeshError(f"F has shape {shape}; pass triangles as (m, 3) vertex indices.{hint}")


def empty(n: int, m: int) -> MeshError:
    """No vertices or no faces."""
    return MeshError(f"The mesh is empty ({n} vertices, {m} faces); there is nothing to map.")


def outside(bad: Ints, n: int, lowest: int, highest: int) -> MeshError:
    """Faces with vertices that are not there; the lowest and highest index of all faces."""
    hint = " Indices start at 0." if lowest >= 1 and highest == n else ""
    return MeshError(f"{len(bad)} faces name vertices outside 0 .. {n - 1}: faces {listed(bad)}.{hint}", bad)


def repeated(bad: Ints) -> DegenerateFaceError:
    """Faces with a vertex twice."""
    return DegenerateFaceError(f"{len(bad)} faces repeat a vertex: faces {listed(bad)}. Remove them.", bad)


def unreferenced(bad: Ints, n: int) -> UnreferencedVertexError:
    """Vertices of no face."""
    return UnreferencedVertexError(
        f"{len(bad)} of {n} vertices belong to no face: vertices {listed(bad)}. Remove them.", bad
    )


def duplicates(twice: Ints) -> DuplicateFaceError:
    """Faces that stand twice."""
    return DuplicateFaceError(
        f"{len(twice)} faces have the same three vertices as another: faces {listed(twice)}. Keep one of each.", twice
    )


def crowded_edges(lo: NDArray[Any], hi: NDArray[Any], faces: Ints) -> NonManifoldError:
    """Edges of three faces."""
    places = ", ".join(f"({a}, {b})" for a, b in zip(lo[:8], hi[:8], strict=True))
    return NonManifoldError(
        f"{len(lo)} edges have three or more faces: edges {places}{' ...' if len(lo) > 8 else ''} "
        f"of faces {listed(faces)}. Remove the extra faces, or cut the surface there.",
        faces,
    )


def one_sided(faces: Ints) -> OrientationError:
    """A surface like a Moebius band."""
    return OrientationError(
        f"The surface has only one side, like a Moebius band ({len(faces)} faces: "
        f"{listed(faces)}); it has no conformal map to the disk. Cut it across the band.",
        faces,
    )


def disagreeing(against: Ints) -> OrientationError:
    """Faces wound the other way."""
    return OrientationError(
        f"{len(against)} faces are wound against their neighbours: faces {listed(against)}. "
        "Reverse their vertex order.",
        against,
    )


def pinched(bad: Ints) -> NonManifoldError:
    """Vertices of several fans."""
    return NonManifoldError(
        f"{len(bad)} vertices join pieces that touch only there: vertices {listed(bad)}. "
        "Split each into one vertex for every fan of faces.",
        bad,
    )


def pinched_boundary(bad: Ints) -> NonManifoldError:
    """Vertices at which two stretches of boundary meet."""
    return NonManifoldError(
        f"{len(bad)} boundary vertices join fans of faces that touch only there: vertices {listed(bad)}. "
        "Split each into one vertex for every fan.",
        bad,
    )


def areas_lost(bad: Ints) -> DegenerateFaceError:
    """Faces whose area is lost to rounding."""
    return DegenerateFaceError(
        f"{len(bad)} faces have no area: faces {listed(bad)}. "
        "Merge their coincident vertices or collapse their shortest edges.",
        bad,
    )


def no_extent(m: int) -> DegenerateFaceError:
    """All vertices on one line."""
    faces = np.arange(m)
    return DegenerateFaceError(
        f"{m} faces have no area: faces {listed(faces)}. All vertices lie on one line or in one point; "
        "give them other positions, or remove the piece.",
        faces,
    )


def several_pieces(pieces: int) -> DisconnectedError:
    """More than one."""
    return DisconnectedError(
        f"The mesh has {pieces} pieces that do not touch; a disk is one. Map each piece by itself, or use unwrap().",
    )


def closed(genus: int) -> TopologyError:
    """No boundary."""
    advice = "Use sphere_map()." if genus == 0 else "Cut it open along its handles first."
    return TopologyError(f"The surface is closed, of genus {genus}: it has no boundary. {advice}")


def several_loops(loops: Sequence[Ints], lengths: Sequence[float], genus: int) -> TopologyError:
    """Holes; the loops and their lengths."""
    told = sorted(((len(loop), length) for loop, length in zip(loops, lengths, strict=True)), reverse=True)
    counts = ", ".join(f"{count} edges" for count, _ in told[:8])
    return TopologyError(
        f"The surface has {len(loops)} boundary loops ({counts}"
        f"{', ...' if len(told) > 8 else ''}) and genus {genus}; a disk has one loop. "
        "Fill the holes, or use unwrap(), which can fill them for the solution.",
        [loop[0] for loop in loops],
    )


def handles(genus: int) -> TopologyError:
    """One loop, but not a disk."""
    return TopologyError(
        f"The surface has one boundary loop but genus {genus}; a disk has no handles. "
        "Cut it open along its handles first.",
    )
