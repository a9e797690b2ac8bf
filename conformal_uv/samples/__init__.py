"""Surfaces made by formula: for the first try, the examples, the tests and the benchmarks."""

from .planar import irregular_disk
from .surfaces import flat_disk, mask, spherical_cap, terrain

__all__ = ["flat_disk", "irregular_disk", "mask", "spherical_cap", "terrain"]
