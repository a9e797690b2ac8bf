"""What the commands disk, free and rectangle do: a mesh file in, the same mesh with conformal UVs out."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import typer

from ..batches.unwrapped_file import stored_uv, unwrapped_file
from ..console.stages import Stages
from ..console.summary import print_summary, unwrapped_summary
from ..console.terminal import plain
from ..errors import Remedy
from ..files import read_mesh, write_mesh
from ..options import Shape, Upright
from ..page import write_page
from ..pictures.figure import draw_map
from .outputs import Outputs

__all__ = ["unwrap_file"]


def unwrap_file(
    shape: Shape,
    *,
    source: Path,
    target: Path,
    seams: str | None,
    upright: Upright,
    split: bool,
    format: str | None,
    json_file: Path | None,
    plot: Path | None,
    html_file: Path | None,
    quiet: bool,
    **options: Any,
) -> None:
    """Read, map, write and tell; `options` are those of `unwrap`.

    Raises
    ------
    ConformalUVError, OSError
        Nothing could be mapped, or not all be written.
    typer.Exit
        Some of several charts were not mapped; the others are written.
    """
    outputs = Outputs(source, target, json_file, plot, html_file, format)
    outputs.check()
    with Stages(quiet=quiet) as stages:
        stages("read", 0.0)
        mesh_file = read_mesh(source, format=format)
        result = unwrapped_file(
            mesh_file,
            seams=seams,
            words=Remedy.as_flag,
            shape=shape,
            upright=upright,
            callback=stages,
            **options,
        )
        stages("distortion", 0.0)
        summary = unwrapped_summary(result, str(source), str(target), stages.seconds)
        corner_uv = stored_uv(result, mesh_file.mesh.sizes)
        outputs.write(
            stages,
            summary,
            lambda path: write_mesh(path, mesh_file, corner_uv=corner_uv, split=split, format=format),
            lambda path: draw_map(path, result, source.name, upright),
            lambda path: write_page(path, result, source.name, upright),
        )
    if not quiet:
        print_summary(summary, stderr=outputs.on_stdout)
    if not result.mapped[result.chart_of_face >= 0].all():
        typer.echo(plain(result.told(Remedy.as_flag)), err=True)
        raise typer.Exit(1)
