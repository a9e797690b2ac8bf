"""Maps of closed genus-0 surfaces onto the unit sphere."""

from .layout import equirectangular, octahedral
from .result import SphereMap
from .sphere_map import sphere_map

__all__ = ["SphereMap", "equirectangular", "octahedral", "sphere_map"]
