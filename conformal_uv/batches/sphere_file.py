"""A closed mesh from a file mapped to the unit sphere, and its image as a file stores it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..files import MeshFile
from ..mesh.polygons import PolygonMesh
from ..mesh.triangulate import triangulate
from ..options import SphereLayout
from ..sphere import SphereMap, sphere_map
from ..sphere.layout import equirectangular, octahedral

__all__ = ["sphere_file", "stored_sphere", "used_triangles"]


def sphere_file(mesh: PolygonMesh, **options: Any) -> SphereMap:
    """The map of the mesh's triangles; `options` are those of `sphere_map`, with its errors."""
    V, F, _ = used_triangles(mesh)
    return sphere_map(V, F, **options)


def stored_sphere(
    result: SphereMap, mesh: PolygonMesh, layout: SphereLayout, path: Path
) -> tuple[MeshFile, NDArray[np.float64]]:
    """The mesh with its vertices on the sphere, those in no face where they are, and its texture coordinates."""
    V = mesh.V.copy()
    V[np.unique(mesh.corners)] = result.xyz
    image = replace(mesh, V=V)
    return MeshFile(path, image), _layout(layout, image)


def used_triangles(mesh: PolygonMesh) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """Vertices in use, triangles over them, and the numbers that these vertices have in the mesh."""
    F, _, _ = triangulate(mesh)
    used, F = np.unique(F, return_inverse=True)
    return mesh.V[used], F.reshape(-1, 3), used


def _layout(layout: SphereLayout, image: PolygonMesh) -> NDArray[np.float64]:
    if layout is SphereLayout.NONE:
        return np.full((len(image.corners), 2), np.nan)
    return (equirectangular if layout is SphereLayout.EQUIRECTANGULAR else octahedral)(image.V, image)
