"""Conformal maps of triangle meshes onto the unit disk, the plane, rectangles and the unit sphere.

Nothing is imported before a name is asked for, so that the command can answer Ctrl-C while numpy and scipy load.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ._version import __version__

if TYPE_CHECKING:
    from .charts import (
        Chart,
        Placement,
        Unwrapped,
        Unwrapper,
        pack_together,
        unwrap,
    )
    from .disk import DiskMap, DiskMapper, disk_map
    from .disk.repair import Repair
    from .distributed import DistributedDiskMap, distributed_disk_map
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
        Remedy,
        SolverError,
        TopologyError,
        UnreferencedVertexError,
    )
    from .free import FreeMap, free_map
    from .mesh import PolygonMesh, Surface
    from .mesh.triangulate import triangulate
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
    from .optimize import AugmentedLagrangianStep, NewtonStep
    from .progress import Callback
    from .rectangle import RectangleMap, rectangle_map
    from .report import DistortionNumbers, UnwrapNumbers, distortion_numbers, flipped_polygons, unwrap_numbers
    from .shape_mapper import ShapeMapper
    from .sphere import SphereMap, equirectangular, octahedral, sphere_map

__all__ = [
    "AugmentedLagrangianStep",
    "Callback",
    "CancelledError",
    "Chart",
    "ConformalUVError",
    "DegenerateFaceError",
    "DisconnectedError",
    "DiskMap",
    "DiskMapper",
    "DistributedDiskMap",
    "Distortion",
    "DistortionNumbers",
    "DuplicateFaceError",
    "FileFormatError",
    "FreeMap",
    "MeshError",
    "MissingDependencyError",
    "Moebius",
    "NewtonStep",
    "NonFiniteError",
    "NonManifoldError",
    "OptionError",
    "OrientationError",
    "Placement",
    "PolygonMesh",
    "RectangleMap",
    "Remedy",
    "Repair",
    "ShapeMapper",
    "SolverError",
    "SphereMap",
    "Surface",
    "TopologyError",
    "UnreferencedVertexError",
    "UnwrapNumbers",
    "Unwrapped",
    "Unwrapper",
    "__version__",
    "cotangent_laplacian",
    "cotangent_laplacian_intrinsic",
    "disk_map",
    "distributed_disk_map",
    "distortion",
    "distortion_numbers",
    "equirectangular",
    "face_areas",
    "flipped_polygons",
    "free_map",
    "gradient",
    "mixed_voronoi_areas",
    "octahedral",
    "pack_together",
    "rectangle_map",
    "sphere_map",
    "triangulate",
    "uniform_laplacian",
    "unwrap",
    "unwrap_numbers",
]

_HOME = {
    "AugmentedLagrangianStep": "optimize",
    "Callback": "progress",
    "CancelledError": "errors",
    "Chart": "charts",
    "ConformalUVError": "errors",
    "DegenerateFaceError": "errors",
    "DisconnectedError": "errors",
    "DiskMap": "disk",
    "DiskMapper": "disk",
    "DistributedDiskMap": "distributed",
    "Distortion": "operators",
    "DistortionNumbers": "report",
    "DuplicateFaceError": "errors",
    "FileFormatError": "errors",
    "FreeMap": "free",
    "MeshError": "errors",
    "MissingDependencyError": "errors",
    "Moebius": "operators",
    "NewtonStep": "optimize",
    "NonFiniteError": "errors",
    "NonManifoldError": "errors",
    "OptionError": "errors",
    "OrientationError": "errors",
    "Placement": "charts",
    "PolygonMesh": "mesh",
    "RectangleMap": "rectangle",
    "Remedy": "errors",
    "Repair": "disk.repair",
    "ShapeMapper": "shape_mapper",
    "SolverError": "errors",
    "SphereMap": "sphere",
    "Surface": "mesh",
    "TopologyError": "errors",
    "UnreferencedVertexError": "errors",
    "UnwrapNumbers": "report",
    "Unwrapped": "charts",
    "Unwrapper": "charts",
    "cotangent_laplacian": "operators",
    "cotangent_laplacian_intrinsic": "operators",
    "disk_map": "disk",
    "distortion": "operators",
    "distributed_disk_map": "distributed",
    "distortion_numbers": "report",
    "equirectangular": "sphere",
    "face_areas": "operators",
    "flipped_polygons": "report",
    "free_map": "free",
    "gradient": "operators",
    "mixed_voronoi_areas": "operators",
    "octahedral": "sphere",
    "pack_together": "charts",
    "rectangle_map": "rectangle",
    "sphere_map": "sphere",
    "triangulate": "mesh.triangulate",
    "uniform_laplacian": "operators",
    "unwrap": "charts",
    "unwrap_numbers": "report",
}


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f".{_HOME[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
