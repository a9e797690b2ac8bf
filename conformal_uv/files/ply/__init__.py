"""PLY (Stanford), text or binary in both byte orders: what the mesh does not need stays as the file has it."""

from .read import read_ply
from .source import PlySource
from .write import write_ply

__all__ = ["PlySource", "read_ply", "write_ply"]
