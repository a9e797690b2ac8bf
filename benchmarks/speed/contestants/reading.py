"""A file to positions and faces in memory: ours, trimesh, meshio, pymeshlab and libigl."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from .outcome import Arrays, Outcome, Stage


def run(arrays: Arrays, stage: Stage, *, program: str) -> Outcome:
    """As little else of the file as the program can be asked for."""
    read = reader(program)
    stage("read")
    read(str(arrays["path"]))
    return Outcome()


def reader(program: str) -> Callable[[str], Any]:
    """The program's function, its library imported."""
    if program == "trimesh":
        from trimesh import load_mesh

        return partial(load_mesh, process=False)
    if program == "meshio":
        from meshio import read

        return read
    if program == "libigl":
        from igl import read_triangle_mesh

        return read_triangle_mesh
    if program == "pymeshlab":
        from pymeshlab import MeshSet

        return lambda path: MeshSet().load_new_mesh(path)
    from conformal_uv.files import read_mesh

    return read_mesh
