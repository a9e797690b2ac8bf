"""Maps of surfaces with disk topology onto the unit disk."""

from .disk_map import disk_map
from .mapper import DiskMapper
from .result import DiskMap

__all__ = ["DiskMap", "DiskMapper", "disk_map"]
