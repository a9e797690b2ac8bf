"""Results that can show themselves, without knowing how.

The methods stand here, at the bottom, and what they do in the room `show`, at the top; the package's own file, which
alone knows both, tells these methods of that room.
"""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from typing import Any, ClassVar

__all__ = ["Shown"]


class Shown:
    """A result with pictures, a web page, and forms for other programs."""

    _room: ClassVar[Callable[[], Any]]

    @staticmethod
    def shown_by(room: Callable[[], Any]) -> None:
        """Tell where the functions are that do it, of the names of these methods; asked when one is first needed."""
        Shown._room = staticmethod(room)

    def plot(self, path: str | PathLike[str] | None = None, *, title: str = "", upright: str = "z") -> Any:
        """The surface, the map and the angle error on it, as a matplotlib figure.

        Parameters
        ----------
        path : path-like, optional
            PNG, PDF or SVG file to be written.
        title : str
        upright : {"z", "y", "none"}
            The axis of the surface that points up.

        Raises
        ------
        MissingDependencyError
            matplotlib is not installed.
        """
        return Shown._room().plot(self, path, title=title, upright=upright)

    def to_html(self, path: str | PathLike[str], *, title: str = "conformal map", upright: str = "z") -> None:
        """Write a web page: the surface beside its map, to be turned, pointed at and, of disks and spheres, dragged."""
        Shown._room().to_html(self, path, title=title, upright=upright)

    def to_trimesh(self, *, image: bool = False) -> Any:
        """The surface as a trimesh.Trimesh, its map as texture coordinates (of a sphere, as an attribute "sphere").

        Parameters
        ----------
        image : bool
            The map itself in the place of the surface: flat, at z = 0, or on the sphere.

        Raises
        ------
        MissingDependencyError
            trimesh is not installed.
        """
        return Shown._room().to_trimesh(self, image=image)

    def to_pyvista(self, *, image: bool = False) -> Any:
        """The surface as a pyvista.PolyData, with texture coordinates and the arrays "angle error" and "area scale".

        Parameters
        ----------
        image : bool
            The map itself in the place of the surface: flat, at z = 0, or on the sphere.

        Raises
        ------
        MissingDependencyError
            pyvista is not installed.
        """
        return Shown._room().to_pyvista(self, image=image)

    def to_polyscope(self, name: str = "surface") -> Any:
        """Register the surface, and its map beside it, with polyscope; then call `polyscope.show()`.

        Returns
        -------
        pair of polyscope.SurfaceMesh
            The surface and the map, with a checker, the angle error and the area scale as quantities.

        Raises
        ------
        MissingDependencyError
            polyscope is not installed.
        """
        return Shown._room().to_polyscope(self, name)

    def _repr_html_(self) -> str:
        """Numbers and a small picture, for notebooks."""
        return Shown._room().summary_html(self)
