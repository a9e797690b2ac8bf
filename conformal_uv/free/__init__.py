"""Maps of surfaces with disk topology to the plane, the boundary free."""

from .free_map import free_map
from .mapper import mapped_free
from .result import FreeMap

__all__ = ["FreeMap", "free_map", "mapped_free"]
