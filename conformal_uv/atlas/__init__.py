"""Many small disks mapped in one go: their Laplacians are blocks of one matrix."""

from .atlas_maps import AtlasMaps
from .disk_atlas import DiskAtlas, takes
from .disks import Disks, sound_disks

__all__ = ["AtlasMaps", "DiskAtlas", "Disks", "sound_disks", "takes"]
