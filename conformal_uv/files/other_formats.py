"""GLB, glTF and 3MF through trimesh, VTK and VTU through meshio."""

from __future__ import annotations

import contextlib
import io
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import FileFormatError
from .checks import checked_mesh, foreign_parser, missing_library
from .mesh_file import MeshFile
from .weld import welded

__all__ = ["MESHIO_SUFFIXES", "TRIMESH_SUFFIXES", "read_with_meshio", "read_with_trimesh"]

TRIMESH_SUFFIXES = (".glb", ".gltf", ".3mf")
MESHIO_SUFFIXES = (".vtk", ".vtu")
SURFACE_CELLS = ("triangle", "quad", "polygon")


def read_with_trimesh(path: Path, data: bytes) -> MeshFile:
    """All meshes of the scene where its transforms put them, joined where corners have exactly the same position.

    These formats keep a vertex for every normal and texture coordinate, so that a closed surface comes in pieces.
    """
    try:
        import trimesh
    except ImportError as error:
        raise missing_library("trimesh", path.suffix) from error
    kind = path.suffix.lower().removeprefix(".")
    with foreign_parser(path, kind.upper(), "trimesh"), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        resolver = trimesh.resolvers.FilePathResolver(str(path)) if kind == "gltf" else None
        scene = trimesh.load_scene(io.BytesIO(data), file_type=kind, process=False, resolver=resolver)
        parts = [part for part in scene.dump() if isinstance(part, trimesh.Trimesh)]
        if not parts:
            raise FileFormatError(f"{path}: the file has no triangles")
        soups = [np.asarray(part.vertices, dtype=np.float64)[part.faces].reshape(-1, 3) for part in parts]
        soup = np.concatenate(soups)
    V, corners = welded(soup)
    return MeshFile(path, checked_mesh(path, V, corners, np.full(len(soup) // 3, 3, np.int64)))


def read_with_meshio(path: Path, data: bytes) -> MeshFile:
    """Triangles, quads and polygons over the file's points; other cells are passed over."""
    try:
        import meshio
    except ImportError as error:
        raise missing_library("meshio", path.suffix) from error
    with foreign_parser(path, path.suffix.removeprefix(".").upper(), "meshio"), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):  # it prints
            try:
                mesh = (meshio.vtk if path.suffix.lower() == ".vtk" else meshio.vtu).read(path)
            except SystemExit as error:  # meshio's own way of saying that it does not know
                raise FileFormatError(f"{path}: meshio does not understand this file") from error
        V = np.asarray(mesh.points, dtype=np.float64)
        if V.ndim != 2 or V.shape[1] not in (2, 3):
            raise FileFormatError(f"{path}: the points are {V.shape}, not three coordinates each")
        V = np.column_stack((V, np.zeros((len(V), 3 - V.shape[1]))))
        corners, sizes = _polygons([block for block in mesh.cells if block.type in SURFACE_CELLS])
    return MeshFile(path, checked_mesh(path, V, corners, sizes))


def _polygons(blocks: list[Any]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    rows = [np.asarray(block.data, dtype=np.int64) for block in blocks]
    corners = np.concatenate([np.empty(0, dtype=np.int64), *(row.reshape(-1) for row in rows)])
    sizes = np.concatenate([np.empty(0, dtype=np.int64), *(np.full(len(row), row.shape[1]) for row in rows)])
    return corners, sizes
