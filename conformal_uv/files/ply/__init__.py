"""PLY (Stanford), text or binary in both byte orders: what the mesh does not need stays as the file has it."""

from conformal_uv.files.ply.read import read_ply
from conformal_uv.files.ply.source import PlySource
from conformal_uv.files.ply.write import write_ply

__all__ = ["PlySource", "read_ply", "write_ply"]
