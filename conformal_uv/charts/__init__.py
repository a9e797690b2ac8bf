"""Charts: polygons with seams, holes, cuts and faults made into disks, mapped and packed."""

from .chart import Chart, Unwrapped
from .packing import Placement
from .together import pack_together
from .unwrap import unwrap
from .unwrapper import Unwrapper

__all__ = ["Chart", "Placement", "Unwrapped", "Unwrapper", "pack_together", "unwrap"]
