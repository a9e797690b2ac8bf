"""Many small disks mapped in one go: their Laplacians are blocks of one matrix."""

from .disk_atlas import DiskAtlas, Turns, takes
from .disk_maps import DiskMaps
from .disks import Disks, neighbours, places, sound_disks
from .factorized_disks import FactorizedDisks
from .free_atlas import Frames, FreeAtlas, takes_free
from .free_maps import FreeMaps

__all__ = [
    "DiskAtlas",
    "DiskMaps",
    "Disks",
    "FactorizedDisks",
    "Frames",
    "FreeAtlas",
    "FreeMaps",
    "Turns",
    "neighbours",
    "places",
    "sound_disks",
    "takes",
    "takes_free",
]
