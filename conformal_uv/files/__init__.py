"""Reading and writing mesh files."""

from conformal_uv.files.atomic import replaced_file
from conformal_uv.files.formats import READABLE, WRITABLE, check_writable, read_mesh, write_mesh
from conformal_uv.files.mesh_file import MeshFile

__all__ = ["READABLE", "WRITABLE", "MeshFile", "check_writable", "read_mesh", "replaced_file", "write_mesh"]
