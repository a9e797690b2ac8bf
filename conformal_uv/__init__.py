"""Conformal maps of triangle meshes onto the unit disk, the plane, rectangles and the unit sphere.

Nothing is imported before a name is asked for, so that the command can answer Ctrl-C while numpy and scipy load.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ._version import __version__
from .shown import Shown

if TYPE_CHECKING:
    from .batches import BatchRow, batch
    from .charts import (
        Chart,
        DiskIsland,
        FlatMesh,
        IslandSurface,
        PinDrag,
        Placement,
        Unwrapped,
        Unwrapper,
        UVIslands,
        disk_islands,
        flattened,
        island_surface,
        pack_islands,
        pack_together,
        unwrap,
        uv_islands,
    )
    from .disk import DiskMap, DiskMapper, disk_map
    from .disk.repair import Repair
    from .distortion_colors import angle_colors, area_colors
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
    from .free import FreeMap, PinnedMapper, free_map, pinned_map
    from .mesh import PolygonMesh, Surface
    from .mesh.triangulate import triangulate
    from .operators import (
        Distortion,
        Moebius,
        PolygonDistortion,
        SphereMoebius,
        cotangent_laplacian,
        cotangent_laplacian_intrinsic,
        distortion,
        face_areas,
        gradient,
        mixed_voronoi_areas,
        polygon_distortion,
        uniform_laplacian,
    )
    from .optimize import AugmentedLagrangianStep, NewtonStep
    from .progress import Callback
    from .rectangle import RectangleMap, rectangle_map
    from .report import (
        DistortionNumbers,
        UnwrapNumbers,
        distortion_numbers,
        flipped_polygons,
        polygon_angle_errors,
        unwrap_numbers,
    )
    from .shape_mapper import ShapeMapper
    from .sphere import (
        SphereMap,
        StoredSphere,
        equirectangular,
        octahedral,
        on_sphere,
        sphere_map,
        stored_sphere,
    )

__all__ = [
    "AugmentedLagrangianStep",
    "BatchRow",
    "Callback",
    "CancelledError",
    "Chart",
    "ConformalUVError",
    "DegenerateFaceError",
    "DisconnectedError",
    "DiskIsland",
    "DiskMap",
    "DiskMapper",
    "DistributedDiskMap",
    "Distortion",
    "DistortionNumbers",
    "DuplicateFaceError",
    "FileFormatError",
    "FlatMesh",
    "FreeMap",
    "IslandSurface",
    "MeshError",
    "MissingDependencyError",
    "Moebius",
    "NewtonStep",
    "NonFiniteError",
    "NonManifoldError",
    "OptionError",
    "OrientationError",
    "PinDrag",
    "PinnedMapper",
    "Placement",
    "PolygonDistortion",
    "PolygonMesh",
    "RectangleMap",
    "Remedy",
    "Repair",
    "ShapeMapper",
    "SolverError",
    "SphereMap",
    "SphereMoebius",
    "StoredSphere",
    "Surface",
    "TopologyError",
    "UVIslands",
    "UnreferencedVertexError",
    "UnwrapNumbers",
    "Unwrapped",
    "Unwrapper",
    "__version__",
    "angle_colors",
    "area_colors",
    "batch",
    "cotangent_laplacian",
    "cotangent_laplacian_intrinsic",
    "disk_islands",
    "disk_map",
    "distributed_disk_map",
    "distortion",
    "distortion_numbers",
    "equirectangular",
    "face_areas",
    "flattened",
    "flipped_polygons",
    "free_map",
    "gradient",
    "island_surface",
    "mixed_voronoi_areas",
    "octahedral",
    "on_sphere",
    "pack_together",
    "pinned_map",
    "pack_islands",
    "polygon_distortion",
    "polygon_angle_errors",
    "rectangle_map",
    "sphere_map",
    "stored_sphere",
    "triangulate",
    "uniform_laplacian",
    "unwrap",
    "unwrap_numbers",
    "uv_islands",
]

_HOME = {
    "AugmentedLagrangianStep": "optimize",
    "BatchRow": "batches",
    "Callback": "progress",
    "CancelledError": "errors",
    "Chart": "charts",
    "ConformalUVError": "errors",
    "DegenerateFaceError": "errors",
    "DisconnectedError": "errors",
    "DiskIsland": "charts",
    "DiskMap": "disk",
    "DiskMapper": "disk",
    "DistributedDiskMap": "distributed",
    "Distortion": "operators",
    "DistortionNumbers": "report",
    "DuplicateFaceError": "errors",
    "FileFormatError": "errors",
    "FlatMesh": "charts",
    "FreeMap": "free",
    "IslandSurface": "charts",
    "MeshError": "errors",
    "MissingDependencyError": "errors",
    "Moebius": "operators",
    "NewtonStep": "optimize",
    "NonFiniteError": "errors",
    "NonManifoldError": "errors",
    "OptionError": "errors",
    "OrientationError": "errors",
    "PinDrag": "charts",
    "PinnedMapper": "free",
    "Placement": "charts",
    "PolygonDistortion": "operators",
    "PolygonMesh": "mesh",
    "RectangleMap": "rectangle",
    "Remedy": "errors",
    "Repair": "disk.repair",
    "ShapeMapper": "shape_mapper",
    "SolverError": "errors",
    "SphereMap": "sphere",
    "SphereMoebius": "operators",
    "StoredSphere": "sphere",
    "Surface": "mesh",
    "TopologyError": "errors",
    "UVIslands": "charts",
    "UnreferencedVertexError": "errors",
    "UnwrapNumbers": "report",
    "Unwrapped": "charts",
    "Unwrapper": "charts",
    "angle_colors": "distortion_colors",
    "area_colors": "distortion_colors",
    "batch": "batches",
    "cotangent_laplacian": "operators",
    "cotangent_laplacian_intrinsic": "operators",
    "disk_islands": "charts",
    "disk_map": "disk",
    "distortion": "operators",
    "distributed_disk_map": "distributed",
    "distortion_numbers": "report",
    "equirectangular": "sphere",
    "face_areas": "operators",
    "flattened": "charts",
    "flipped_polygons": "report",
    "free_map": "free",
    "gradient": "operators",
    "island_surface": "charts",
    "mixed_voronoi_areas": "operators",
    "octahedral": "sphere",
    "on_sphere": "sphere",
    "pack_together": "charts",
    "pinned_map": "free",
    "pack_islands": "charts",
    "polygon_distortion": "operators",
    "polygon_angle_errors": "report",
    "rectangle_map": "rectangle",
    "sphere_map": "sphere",
    "stored_sphere": "sphere",
    "triangulate": "mesh.triangulate",
    "uniform_laplacian": "operators",
    "unwrap": "charts",
    "unwrap_numbers": "report",
    "uv_islands": "charts",
}


Shown.shown_by(lambda: import_module(".show", __name__))


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f".{_HOME[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
