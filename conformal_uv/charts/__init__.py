"""Charts: polygons with seams, holes, cuts and faults made into disks, mapped and packed."""

from .chart import Chart
from .chart_list import ChartList
from .packing import Placement
from .together import pack_together
from .unwrap import unwrap
from .unwrapped import Unwrapped
from .unwrapper import Unwrapper

__all__ = ["Chart", "ChartList", "Placement", "Unwrapped", "Unwrapper", "pack_together", "unwrap"]
