"""Discrete operators on triangle meshes: Laplacians, areas, gradient, Dirichlet problems, distortion."""

from .areas import face_areas, mixed_voronoi_areas
from .dirichlet import DirichletProblem
from .distortion import Distortion, distortion
from .gradient import gradient
from .laplacian import cotangent_laplacian, cotangent_laplacian_intrinsic, uniform_laplacian
from .moebius import Moebius
from .polygon_distortion import PolygonDistortion, polygon_distortion
from .sphere_moebius import SphereMoebius

__all__ = [
    "DirichletProblem",
    "Distortion",
    "Moebius",
    "SphereMoebius",
    "PolygonDistortion",
    "cotangent_laplacian",
    "cotangent_laplacian_intrinsic",
    "distortion",
    "face_areas",
    "gradient",
    "mixed_voronoi_areas",
    "polygon_distortion",
    "uniform_laplacian",
]
