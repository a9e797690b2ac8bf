"""Saving a mesh with its texture coordinates and images, around what pymeshlab's writers lose."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from conformal_uv import FileFormatError

from .exceptions import pymeshlab_errors
from .formats import check_target

__all__ = ["check_texture_linked", "save_textured_mesh"]


def save_textured_mesh(ms: Any, path: str | os.PathLike[str], *, keep_images: bool = False) -> None:
    """Save the current mesh with texture coordinates: OBJ, PLY, DAE or OFF.

    As ``ms.save_current_mesh(path)`` but for this: polygons go into an OBJ as triangles, since pymeshlab writes
    random numbers as texture coordinates of polygons; what a format would lose is refused; existing files are
    replaced only after everything was written.

    Parameters
    ----------
    ms : pymeshlab.MeshSet
    path : path-like
        The file; materials and images are written beside it.
    keep_images : bool
        Leave images that are there already under the name of one of the mesh's.

    Raises
    ------
    ConformalFilterException
        The format or this mesh in it would lose texture coordinates (the cause is a FileFormatError), or the
        folder can not be written.
    pymeshlab.PyMeshLabException
        pymeshlab could not write the file.
    """
    with pymeshlab_errors("save_textured_mesh"):
        target = check_target(path)
        check_texture_linked(ms.current_mesh(), target)
        _check_whole(ms.current_mesh(), target)
    options = {"save_polygonal": False} if target.suffix.lower() == ".obj" else {}
    with tempfile.TemporaryDirectory(prefix=".conformal_uv_", dir=target.parent) as folder:
        ms.save_current_mesh(os.path.join(folder, target.name), **options)
        _move(Path(folder), target, keep_images)


def check_texture_linked(mesh: Any, target: Path) -> None:
    """Raise FileFormatError where the file has texture coordinates only with a texture, and `mesh` has none."""
    if target.suffix.lower() == ".dae" and not mesh.texture_number():
        raise FileFormatError(
            f"{target}: pymeshlab writes texture coordinates to .dae only for meshes with a texture; link one "
            "(--texture checker, or texture=...), or use .obj or .ply"
        )


def _check_whole(mesh: Any, target: Path) -> None:
    """Raise FileFormatError where the file can not hold all texture coordinates of `mesh`."""
    if target.suffix.lower() != ".off" or not (mesh.has_wedge_tex_coord() and mesh.has_vertex_tex_coord()):
        return
    corner = mesh.face_matrix().reshape(-1)
    torn = np.unique(corner[(mesh.vertex_tex_coord_matrix()[corner] != mesh.wedge_tex_coord_matrix()).any(axis=1)])
    if len(torn):
        raise FileFormatError(
            f"{target}: .off keeps one texture coordinate a vertex, and {len(torn)} vertices have several; "
            "use .obj, .ply or .dae"
        )


def _move(folder: Path, target: Path, keep_images: bool) -> None:
    """Put all written files in place, the mesh last."""
    written = sorted((file for file in folder.rglob("*") if file.is_file()), key=lambda file: file.name == target.name)
    for file in written:
        place = Path(os.path.realpath(target.parent / file.relative_to(folder)))  # behind symbolic links
        companion = place.name == target.name or place.suffix.lower() == ".mtl"
        if keep_images and not companion and place.exists():
            continue
        place.parent.mkdir(parents=True, exist_ok=True)
        if place.exists():
            os.chmod(file, place.stat().st_mode & 0o7777)
        os.replace(file, place)
