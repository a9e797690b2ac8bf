"""Reading and writing mesh files."""

from conformal_uv.files.atomic import replaced_file
from conformal_uv.files.formats import READABLE, WRITABLE, check_writable, read_mesh, write_mesh
from conformal_uv.files.mesh_file import MeshFile
from conformal_uv.files.places import check_distinct, check_place, is_standard_output, is_stream

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
    "replaced_file",
    "write_mesh",
]
