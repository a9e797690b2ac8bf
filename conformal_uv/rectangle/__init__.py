"""Maps of surfaces with disk topology onto rectangles."""

from .mapper import mapped_rectangle
from .rectangle_map import rectangle_map
from .result import RectangleMap

__all__ = ["RectangleMap", "mapped_rectangle", "rectangle_map"]
