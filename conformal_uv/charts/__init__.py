"""Charts: polygons with seams, holes, cuts and faults made into disks, mapped and packed."""

from .chart import Chart
from .chart_list import ChartList
from .flattened import FlatMesh, flattened
from .packing import Placement
from .repacked import pack_islands
from .together import pack_together
from .unwrap import unwrap
from .unwrapped import Unwrapped
from .unwrapper import Unwrapper
from .uv_islands import uv_islands

__all__ = [
    "Chart",
    "ChartList",
    "FlatMesh",
    "Placement",
    "Unwrapped",
    "Unwrapper",
    "flattened",
    "pack_islands",
    "pack_together",
    "unwrap",
    "uv_islands",
]
