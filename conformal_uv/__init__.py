"""Conformal maps of triangle meshes onto the unit disk and the unit sphere.

Nothing is imported before a name is asked for, so that the command can answer Ctrl-C while numpy and scipy load.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ._version import __version__

if TYPE_CHECKING:
    from .charts import Chart, Unwrapped, Unwrapper, unwrap
    from .disk import DiskMap, DiskMapper, disk_map
    from .errors import (
        CancelledError,
        ConformalUVError,
        DegenerateFaceError,
        DisconnectedError,
        DuplicateFaceError,
        FileFormatError,
        MeshError,
        MissingDependencyError,
        NonFiniteError,
        NonManifoldError,
        OptionError,
        OrientationError,
        SolverError,
        TopologyError,
        UnreferencedVertexError,
    )
    from .operators import (
        Distortion,
        Moebius,
        cotangent_laplacian,
        cotangent_laplacian_intrinsic,
        distortion,
        face_areas,
        gradient,
        mixed_voronoi_areas,
        uniform_laplacian,
    )
    from .sphere import SphereMap, sphere_map

__all__ = [
    "CancelledError",
    "Chart",
    "ConformalUVError",
    "DegenerateFaceError",
    "DisconnectedError",
    "DiskMap",
    "DiskMapper",
    "Distortion",
    "DuplicateFaceError",
    "FileFormatError",
    "MeshError",
    "MissingDependencyError",
    "Moebius",
    "NonFiniteError",
    "NonManifoldError",
    "OptionError",
    "OrientationError",
    "SolverError",
    "SphereMap",
    "TopologyError",
    "UnreferencedVertexError",
    "Unwrapped",
    "Unwrapper",
    "__version__",
    "cotangent_laplacian",
    "cotangent_laplacian_intrinsic",
    "disk_map",
    "distortion",
    "face_areas",
    "gradient",
    "mixed_voronoi_areas",
    "sphere_map",
    "uniform_laplacian",
    "unwrap",
]

_HOME = {
    "CancelledError": "errors",
    "Chart": "charts",
    "ConformalUVError": "errors",
    "DegenerateFaceError": "errors",
    "DisconnectedError": "errors",
    "DiskMap": "disk",
    "DiskMapper": "disk",
    "Distortion": "operators",
    "DuplicateFaceError": "errors",
    "FileFormatError": "errors",
    "MeshError": "errors",
    "MissingDependencyError": "errors",
    "Moebius": "operators",
    "NonFiniteError": "errors",
    "NonManifoldError": "errors",
    "OptionError": "errors",
    "OrientationError": "errors",
    "SolverError": "errors",
    "SphereMap": "sphere",
    "TopologyError": "errors",
    "UnreferencedVertexError": "errors",
    "Unwrapped": "charts",
    "Unwrapper": "charts",
    "cotangent_laplacian": "operators",
    "cotangent_laplacian_intrinsic": "operators",
    "disk_map": "disk",
    "distortion": "operators",
    "face_areas": "operators",
    "gradient": "operators",
    "mixed_voronoi_areas": "operators",
    "sphere_map": "sphere",
    "uniform_laplacian": "operators",
    "unwrap": "charts",
}


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f".{_HOME[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
