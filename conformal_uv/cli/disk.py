"""conformal-uv disk: a mesh file in, the same mesh with conformal UVs out."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from ..charts import Unwrapped, unwrap
from ..console.stages import Stages
from ..console.summary import print_summary, unwrapped_summary
from ..console.terminal import plain
from ..errors import Remedy
from ..files import read_mesh, write_mesh
from ..options import (
    Backend,
    Closed,
    Holes,
    Laplacian,
    Method,
    NonManifold,
    Objective,
    Orientation,
    PinMode,
    Place,
    Repair,
)
from .figure import draw_unwrapped
from .numbers import three_numbers
from .outputs import Outputs
from .seams import read_seams

__all__ = ["disk"]


def disk(
    source: Annotated[Path, typer.Argument(metavar="IN", help="Mesh: OBJ, PLY, OFF, STL, NPZ, GLB ...; - is stdin.")],
    target: Annotated[Path, typer.Argument(metavar="OUT", help="Mesh with UVs: OBJ, PLY or NPZ; - is stdout.")],
    method: Annotated[Method, typer.Option(help="How the map is found.")] = Method.AUTO,
    objective: Annotated[Objective | None, typer.Option(help="Energy to be minimised.")] = None,
    pins: Annotated[
        str | None,
        typer.Option(metavar="A,B,C", help="Boundary vertices (from 0) sent to 1, w, w^2 with w = exp(2 pi i / 3)."),
    ] = None,
    pin_mode: Annotated[PinMode | None, typer.Option(help="How the pins are reached.")] = None,
    center: Annotated[int | None, typer.Option(metavar="V", help="Vertex (from 0) sent to the center.")] = None,
    boundary_vertex: Annotated[
        int | None, typer.Option(metavar="V", help="Boundary vertex (from 0) sent to angle 0.")
    ] = None,
    seams: Annotated[
        str | None,
        typer.Option(metavar="FILE|uv", help="Edges to cut along: lines of two vertices, or where UVs are torn."),
    ] = None,
    holes: Annotated[Holes, typer.Option(help="Boundary loops but the longest.")] = Holes.FILL,
    closed: Annotated[Closed, typer.Option(help="Closed pieces and handles.")] = Closed.REFUSE,
    nonmanifold: Annotated[
        NonManifold, typer.Option(help="Edges of three faces, pieces that touch in a vertex.")
    ] = NonManifold.REFUSE,
    orientation: Annotated[
        Orientation, typer.Option(help="Faces wound against their neighbours.")
    ] = Orientation.REFUSE,
    laplacian: Annotated[Laplacian, typer.Option(help="Weights.")] = Laplacian.AUTO,
    repair: Annotated[Repair, typer.Option(help="Folded triangles.")] = Repair.AUTO,
    place: Annotated[Place, typer.Option(help="Placing in the unit square.")] = Place.FIT,
    backend: Annotated[Backend, typer.Option(help="Factorization library.")] = Backend.AUTO,
    split: Annotated[
        bool, typer.Option("--split", help="Write vertices split at seams, for programs that know one UV a vertex.")
    ] = False,
    format: Annotated[
        str | None, typer.Option(metavar="obj|ply|npz", help="Of standard input and output (-); by default obj.")
    ] = None,
    json_file: Annotated[Path | None, typer.Option("--json", metavar="FILE", help="Write all numbers.")] = None,
    plot: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Draw the surface, the flattened mesh and its angle error.")
    ] = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress bar and no table.")] = False,
) -> None:
    """Map surfaces with disk topology onto the unit disk.

    One surface fills the unit square of texture space: u, v = 0.5 + 0.5 (x, y). Several charts (pieces, or parts
    between seams) are packed into it.
    """
    pinned = three_numbers(pins)
    outputs = Outputs(source, target, json_file, plot, format)
    outputs.check()
    with Stages(quiet=quiet) as stages:
        stages("read", 0.0)
        mesh_file = read_mesh(source, format=format)
        result = unwrap(
            None,
            mesh_file.mesh,
            seams=read_seams(seams, mesh_file),
            method=method,
            objective=objective if objective else None,
            pins=pinned,
            pin_mode=pin_mode if pin_mode else None,
            center=center,
            boundary_vertex=boundary_vertex,
            holes=holes,
            closed=closed,
            nonmanifold=nonmanifold,
            orientation=orientation,
            laplacian=laplacian,
            repair=repair,
            backend=backend,
            place=place,
            callback=stages,
        )
        failure = result.failure(Remedy.as_flag)
        if failure is not None:
            raise failure
        stages("distortion", 0.0)
        summary = unwrapped_summary(result, str(source), str(target), stages.seconds)
        corner_uv = _corner_uv(result, mesh_file.mesh.sizes)
        outputs.write(
            stages,
            summary,
            lambda path: write_mesh(path, mesh_file, corner_uv=corner_uv, split=split, format=format),
            lambda path: draw_unwrapped(path, result, source.name),
        )
    if not quiet:
        print_summary(summary, stderr=outputs.on_stdout)
    if not result.mapped[result.chart_of_face >= 0].all():
        typer.echo(plain(result.told(Remedy.as_flag)), err=True)
        raise typer.Exit(1)


def _corner_uv(result: Unwrapped, sizes: np.ndarray) -> np.ndarray:
    """Texture coordinates of all corners; NaN, which leaves a file's own ones, where nothing was mapped."""
    uv = result.uv.copy()
    uv[~np.repeat(result.mapped, sizes)] = np.nan
    return uv
