"""What results can do by themselves (`Shown`): pictures, pages, and forms for other programs."""

from .pictures import plot, to_html
from .polyscope_scene import to_polyscope
from .summary import summary_html
from .to_meshes import to_pyvista, to_trimesh

__all__ = ["plot", "summary_html", "to_html", "to_polyscope", "to_pyvista", "to_trimesh"]
