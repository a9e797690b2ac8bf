"""Charts: polygons with seams, holes, cuts and faults made into disks, mapped and packed."""

from .chart import Chart
from .chart_list import ChartList
from .disk_islands import DiskIsland, disk_islands
from .flattened import FlatMesh, flattened
from .island_surface import IslandSurface, island_surface
from .packing import Placement
from .pin_drag import PinDrag
from .repacked import pack_islands
from .together import pack_together
from .unwrap import unwrap
from .unwrapped import Unwrapped
from .unwrapper import Unwrapper
from .uv_islands import UVIslands, uv_islands

__all__ = [
    "Chart",
    "ChartList",
    "DiskIsland",
    "IslandSurface",
    "PinDrag",
    "Placement",
    "UVIslands",
    "Unwrapped",
    "Unwrapper",
    "disk_islands",
    "island_surface",
    "FlatMesh",
    "flattened",
    "pack_islands",
    "pack_together",
    "unwrap",
    "uv_islands",
]
