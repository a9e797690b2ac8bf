"""Reading and writing mesh files."""

from .atomic import replaced_file
from .formats import READABLE, WRITABLE, check_writable, read_mesh, write_mesh
from .mesh_file import MeshFile
from .places import check_distinct, check_place, is_standard_output, is_stream
from .seams import read_seams

__all__ = [
    "READABLE",
    "WRITABLE",
    "MeshFile",
    "check_distinct",
    "check_place",
    "check_writable",
    "is_standard_output",
    "is_stream",
    "read_mesh",
    "read_seams",
    "replaced_file",
    "write_mesh",
]
