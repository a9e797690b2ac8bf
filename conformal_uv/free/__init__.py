"""Maps of surfaces with disk topology to the plane, the boundary free; with some vertices at given places of any."""

from .free_map import free_map
from .mapper import mapped_free
from .pinned_map import PinnedMapper, pinned_map
from .result import FreeMap

__all__ = ["FreeMap", "PinnedMapper", "free_map", "mapped_free", "pinned_map"]
