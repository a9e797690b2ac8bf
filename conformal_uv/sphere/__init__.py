"""Maps of closed genus-0 surfaces onto the unit sphere."""

from .layout import equirectangular, octahedral, on_sphere
from .result import SphereMap
from .sphere_map import sphere_map
from .stored_sphere import StoredSphere, stored_sphere

__all__ = [
    "SphereMap",
    "StoredSphere",
    "equirectangular",
    "octahedral",
    "on_sphere",
    "sphere_map",
    "stored_sphere",
]
