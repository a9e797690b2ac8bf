"""conformal-uv disk: a mesh file in, the same mesh with conformal UVs out."""

from __future__ import annotations

import json
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from ..disk import DiskMap, disk_map
from ..files import MeshFile, check_writable, read_mesh, replaced_file, write_mesh
from ..mesh.triangulate import triangulate
from .figure import check_drawable, draw_disk_map
from .stages import Stages
from .summary import disk_summary, print_summary

__all__ = ["disk"]


class MethodChoice(StrEnum):
    """Values of --method."""

    NEWTON = "newton"
    LINEAR = "linear"
    AUGMENTED_LAGRANGIAN = "augmented-lagrangian"


class ObjectiveChoice(StrEnum):
    """Values of --objective."""

    CONFORMAL = "conformal"
    DIRICHLET = "dirichlet"


class PinModeChoice(StrEnum):
    """Values of --pin-mode."""

    MOEBIUS = "moebius"
    CONSTRAINT = "constraint"


class BackendChoice(StrEnum):
    """Values of --backend."""

    AUTO = "auto"
    CHOLMOD = "cholmod"
    SUPERLU = "superlu"


def _three(text: str | None) -> tuple[int, int, int] | None:
    if text is None:
        return None
    try:
        a, b, c = (int(part) for part in text.split(","))
    except ValueError as error:
        raise typer.BadParameter(f"{text!r} is not three vertex numbers, such as 0,31,62") from error
    return a, b, c


def disk(
    source: Annotated[Path, typer.Argument(metavar="IN", help="Mesh: OBJ, PLY, OFF, STL or NPZ.")],
    target: Annotated[Path, typer.Argument(metavar="OUT", help="Mesh with UVs: OBJ, PLY or NPZ.")],
    method: Annotated[MethodChoice, typer.Option(help="How the map is found.")] = MethodChoice.NEWTON,
    objective: Annotated[ObjectiveChoice | None, typer.Option(help="Energy to be minimised.")] = None,
    pins: Annotated[
        str | None,
        typer.Option(metavar="A,B,C", help="Boundary vertices (from 0) sent to 1, w, w^2 with w = exp(2 pi i / 3)."),
    ] = None,
    pin_mode: Annotated[PinModeChoice | None, typer.Option(help="How the pins are reached.")] = None,
    center: Annotated[int | None, typer.Option(metavar="V", help="Vertex (from 0) sent to the centre.")] = None,
    boundary_vertex: Annotated[
        int | None, typer.Option(metavar="V", help="Boundary vertex (from 0) sent to angle 0.")
    ] = None,
    backend: Annotated[BackendChoice, typer.Option(help="Factorization library.")] = BackendChoice.AUTO,
    json_file: Annotated[Path | None, typer.Option("--json", metavar="FILE", help="Write all numbers.")] = None,
    plot: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Draw the surface, the flattened mesh and its angle error.")
    ] = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress bar and no table.")] = False,
) -> None:
    """Map a surface with disk topology onto the unit disk.

    The disk is placed in the unit square of texture space: u, v = 0.5 + 0.5 (x, y).
    """
    pinned = _three(pins)
    check_writable(target)
    if plot is not None:
        check_drawable(plot)
    with Stages(quiet=quiet) as stages:
        stages("read", 0.0)
        mesh_file = read_mesh(source)
        F, _, _ = triangulate(mesh_file.mesh)
        result = disk_map(
            mesh_file.mesh.V,
            F,
            method=method.value,
            objective=objective.value if objective else None,
            pins=pinned,
            pin_mode=pin_mode.value if pin_mode else None,
            center=center,
            boundary_vertex=boundary_vertex,
            backend=backend.value,
            callback=stages,
        )
        stages("distortion", 0.0)
        _ = result.distortion
        stages("write", 0.0)
        write_mesh(target, mesh_file, corner_uv=_in_unit_square(result, mesh_file))
        if plot is not None:
            stages("plot", 0.0)
            draw_disk_map(plot, result, source.name)
    summary = disk_summary(result, str(source), str(target), stages.seconds)
    if json_file is not None:
        with replaced_file(json_file) as out:
            out.write(json.dumps(summary, indent=2).encode())
    if not quiet:
        print_summary(summary)


def _in_unit_square(result: DiskMap, mesh_file: MeshFile) -> np.ndarray:
    return (0.5 + 0.5 * result.uv)[mesh_file.mesh.corners]
