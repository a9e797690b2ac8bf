"""One surface over many processes: its rows spread by MPI, its linear systems solved by PETSc."""

from __future__ import annotations

from .disk_map import DistributedDiskMap, distributed_disk_map
from .files import read_slice, write_slices
from .numbers import MapNumbers

__all__ = ["DistributedDiskMap", "MapNumbers", "distributed_disk_map", "read_slice", "write_slices"]
