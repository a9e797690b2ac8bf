"""Meshes: arrays checked once, half-edges, boundary loops, polygons."""

from .polygons import PolygonMesh
from .surface import Surface

__all__ = ["PolygonMesh", "Surface"]
