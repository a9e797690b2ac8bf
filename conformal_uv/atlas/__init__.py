"""Many small disks mapped in one go: their Laplacians are blocks of one matrix."""

from .atlas_maps import AtlasMaps
from .disk_atlas import DiskAtlas, Turns, takes
from .disks import Disks, places, sound_disks

__all__ = ["AtlasMaps", "DiskAtlas", "Disks", "Turns", "places", "sound_disks", "takes"]
