"""The filter: the current mesh's vertices moved to their conformal image on the unit sphere."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from conformal_uv import Callback, SphereMap, distortion_numbers, sphere_map

from .current_mesh import read_current_mesh
from .exceptions import pymeshlab_errors
from .function_filters import check_function_filters, vertex_variable
from .quality import Quality, distortion_fields
from .script_history import unrecorded
from .texcoords import write_face_scalar

__all__ = ["compute_coord_conformal_sphere"]

NAME = "compute_coord_conformal_sphere"


def compute_coord_conformal_sphere(
    ms: Any,
    *,
    method: str = "auto",
    normalization: str = "area",
    rotation: str = "principal",
    landmarks: Iterable[int] | None = None,
    boundary: str = "refuse",
    repair: str = "auto",
    laplacian: str = "auto",
    backend: str = "auto",
    quality: str = "none",
    callback: Callback | None = None,
) -> dict[str, float]:
    """Move the vertices of the current mesh to a conformal map onto the unit sphere, in place.

    The mesh must be one closed surface of genus 0. Only vertex positions change (and, when asked for, the per-face
    scalar); normals are computed anew. After an exception the MeshSet is as it was.

    Parameters
    ----------
    ms : pymeshlab.MeshSet
    method : Enum
        'auto' (default: the least angle error), 'linear', 'schwarz', 'newton', 'augmented-lagrangian'.
    normalization : Enum
        What comes to the middle of the ball: the centre of mass of the 'area' (default), of the vertices ('center'),
        or 'none'.
    rotation : Enum
        'principal' (axes of the mass), 'surface' (nearest to the surface's own directions), 'none'.
    landmarks : three Integers
        Vertices sent to (0, 0, -1), (1, 0, 0) and (0, 0, 1), in the place of normalization and rotation.
    boundary : Enum
        Boundary loops: 'refuse' or 'cap' (for the solution only).
    repair : Enum
        Inverted triangles: 'auto' unfolds them, 'never' leaves them.
    laplacian : Enum
        'auto', 'cotan', 'intrinsic-delaunay'.
    backend : Enum
        'auto', 'cholmod', 'superlu', 'multigrid'.
    quality : Enum
        Per-face scalar to write: 'none', 'angle' (mean angle error, degrees), 'quasi-conformal'.
    callback : callable
        Called as ``callback(stage, fraction)``; returning False stops the filter.

    Returns
    -------
    dict of numbers
        angle_error_mean, angle_error_sd, angle_error_max (degrees), conformal_energy, dirichlet_energy,
        signed_volume, flipped_faces, repaired_faces, converged.

    Raises
    ------
    pymeshlab.PyMeshLabException
        The MeshSet has no current mesh.
    ConformalFilterException
        A PyMeshLabException: an option is not taken, or the surface is no sphere; ``__cause__`` tells the kind.
    """
    with pymeshlab_errors(NAME):
        scalar = Quality.of("quality", quality)
        source = read_current_mesh(ms)
        with unrecorded(ms):
            check_function_filters(ms)
        used, F = np.unique(source.F, return_inverse=True)
        result = sphere_map(
            source.polygons.V[used],
            F.reshape(-1, 3),
            method=method,
            normalization=normalization,
            rotation=rotation,
            landmarks=None if landmarks is None else list(landmarks),
            boundary=boundary,
            repair=repair,
            laplacian=laplacian,
            backend=backend,
            callback=callback,
        )
        numbers = _numbers(result)
        xyz = source.polygons.V.copy()
        xyz[used] = result.xyz
        x, y, z = (vertex_variable(source.mesh, f"sphere_{axis}", xyz[:, k]) for k, axis in enumerate("xyz"))
        with unrecorded(ms):
            ms.compute_coord_by_function(x=x, y=y, z=z)
            if scalar is not Quality.NONE:
                d = result.distortion
                values = d.angle_error.mean(axis=1) if scalar is Quality.ANGLE else d.quasi_conformal
                values = values[: len(source.F)]  # caps come after
                write_face_scalar(ms, source.mesh, values, np.isfinite(values))
    return numbers


def _numbers(result: SphereMap) -> dict[str, float]:
    return {
        **distortion_fields(distortion_numbers([result.distortion])),
        "conformal_energy": result.conformal_energy,
        "dirichlet_energy": result.dirichlet_energy,
        "signed_volume": result.signed_volume,
        "flipped_faces": len(result.flipped),
        "repaired_faces": result.repaired,
        "converged": int(result.converged),
    }
