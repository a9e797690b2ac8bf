"""conformal-uv-meshlab: mesh files of every format that pymeshlab reads, with conformal UVs out."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Any

import typer

from conformal_uv import ConformalUVError, OptionError, Remedy
from conformal_uv.console.interrupt import interruptible
from conformal_uv.console.stages import Stages
from conformal_uv.console.summary import print_summary
from conformal_uv.console.terminal import plain
from conformal_uv.files import check_distinct, check_place, is_standard_output, replaced_file
from conformal_uv.options import (
    Closed,
    CornerChoice,
    Holes,
    Method,
    NonManifold,
    Orientation,
    Repair,
    Shape,
    Upright,
)

from .conversion import CHECKER, Conversion, check_filter_script, convert
from .library import pymeshlab
from .quality import Quality
from .shape_options import shape_options
from .targets import output_files
from .texcoords import check_texture

__all__ = ["app"]

app = typer.Typer(name="conformal-uv-meshlab", pretty_exceptions_enable=False, add_completion=False)

EXPECTED = (ConformalUVError, pymeshlab.PyMeshLabException, OSError)


@app.command()
@interruptible
def flatten(
    sources: Annotated[list[Path], typer.Argument(metavar="IN...", help="Meshes in any format pymeshlab reads.")],
    target: Annotated[Path, typer.Argument(metavar="OUT", help="OBJ, PLY, DAE or OFF file, or a folder.")],
    shape: Annotated[Shape, typer.Option(help="What surfaces become.")] = Shape.DISK,
    upright: Annotated[Upright, typer.Option(help="Axis that points up in the texture.")] = Upright.Z,
    method: Annotated[Method | None, typer.Option(help="How a disk is found; by default auto.")] = None,
    holes: Annotated[Holes, typer.Option(help="Boundary loops but the longest.")] = Holes.FILL,
    closed: Annotated[Closed, typer.Option(help="Closed pieces and handles.")] = Closed.REFUSE,
    nonmanifold: Annotated[
        NonManifold, typer.Option(help="Edges of three faces, pieces that touch in a vertex.")
    ] = NonManifold.REFUSE,
    orientation: Annotated[
        Orientation, typer.Option(help="Faces wound against their neighbours.")
    ] = Orientation.REFUSE,
    repair: Annotated[Repair, typer.Option(help="Folded triangles.")] = Repair.AUTO,
    center: Annotated[int | None, typer.Option(metavar="V", help="Vertex (from 0) sent to a disk's center.")] = None,
    refine: Annotated[bool, typer.Option("--refine", help="Of free boundaries: a smaller angle error.")] = False,
    corners: Annotated[
        str | None, typer.Option(metavar="A,B,C,D", help="Boundary vertices (from 0), corners of a rectangle.")
    ] = None,
    corner_choice: Annotated[CornerChoice | None, typer.Option(help="Of a rectangle; by default turning.")] = None,
    texture: Annotated[str | None, typer.Option(metavar="FILE|checker", help="Image to link.")] = None,
    quality: Annotated[Quality, typer.Option(help="Per-face scalar to write (PLY keeps it).")] = Quality.NONE,
    filter_script: Annotated[
        Path | None, typer.Option("--script", metavar="FILE.mlx", help="MeshLab filter script to run first.")
    ] = None,
    suffix: Annotated[str | None, typer.Option("--format", metavar="ply|obj|...", help="With a folder as OUT.")] = None,
    json_file: Annotated[Path | None, typer.Option("--json", metavar="FILE", help="Write all numbers.")] = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Only failures.")] = False,
) -> None:
    """Give meshes conformal UVs: surfaces onto disks or rectangles, or with their own outline, angles kept."""
    options = {
        "upright": upright,
        "holes": holes,
        "closed": closed,
        "nonmanifold": nonmanifold,
        "orientation": orientation,
        "repair": repair,
        "quality": quality,
    }
    try:
        options |= shape_options(
            shape, method=method, center=center, refine=refine, corners=corners, corner_choice=corner_choice
        )
        targets = _checked(sources, target, suffix, texture, filter_script, json_file)
    except EXPECTED as error:
        typer.echo(plain(_told(error)), err=True)
        raise typer.Exit(1) from error
    if not quiet and any(file.suffix.lower() == ".off" for file in targets):
        typer.echo("warning: MeshLab does not read the texture coordinates of .off files back", err=True)
    quiet = quiet or is_standard_output(json_file)
    told = _convert_all(sources, targets, Conversion(texture, filter_script, options, shape), quiet)
    failures = [line for line in map(_failure, told) if line]
    if json_file is not None:
        try:
            with replaced_file(json_file) as out:
                out.write((json.dumps(told if len(told) > 1 else told[0], indent=2) + "\n").encode())
        except EXPECTED as error:
            failures.append(_told(error))
    for line in failures:
        typer.echo(plain(line), err=True)
    if failures:
        raise typer.Exit(1)


def _checked(
    sources: list[Path],
    target: Path,
    suffix: str | None,
    texture: str | None,
    filter_script: Path | None,
    json_file: Path | None,
) -> list[Path]:
    """The output files; every refusal that needs no work comes from here."""
    targets = output_files(sources, target, suffix)
    if json_file is not None:
        for source, own in zip(sources, targets, strict=True):
            check_distinct(source, {"OUT": own, "--json": json_file})
        check_place(json_file)
    if texture is not None and texture != CHECKER:
        check_texture(texture)
    if filter_script is not None:
        check_filter_script(filter_script)
    missing = [source for source in sources if not source.is_file()]
    if missing and len(missing) == len(sources):
        raise OptionError(f"No such file: {', '.join(map(str, missing))}.")
    return targets


def _convert_all(sources: list[Path], targets: list[Path], conversion: Conversion, quiet: bool) -> list[dict[str, Any]]:
    """Map each; its numbers, or its error."""
    told = []
    for source, target in zip(sources, targets, strict=True):
        try:
            with Stages(quiet=quiet) as stages:
                numbers = convert(source, target, conversion, stages)
        except EXPECTED as error:
            told.append({"input": str(source), "error": _told(error)})
            if len(sources) > 1 and not quiet:
                typer.echo(plain(f"{source}: failed"))
            continue
        told.append(numbers)
        if quiet:
            continue
        if len(sources) == 1:
            print_summary(numbers)
        else:
            typer.echo(plain(_line(numbers)))
    return told


def _line(numbers: dict[str, Any]) -> str:
    """One file's map in one line."""
    mesh, angle = numbers["mesh"], numbers["angle_error_degrees"]
    charts = f"{numbers['summary'].partition(';')[0]}, " if len(numbers["charts"]) > 1 else ""
    return (
        f"{numbers['input']} -> {numbers['output']}: {charts}{mesh['mapped_faces']} of {mesh['faces']} faces, angle "
        f"error mean {angle['mean']:.3g}, max {angle['max']:.3g} degrees, {numbers['flipped_faces']} flipped"
    )


def _failure(numbers: dict[str, Any]) -> str | None:
    """What to say at the end of a file that failed, or of which a part was not mapped."""
    if "error" in numbers:
        return f"{numbers['input']}: {numbers['error']}"
    if any(chart["status"] == "failed" for chart in numbers["charts"]):
        return f"{numbers['input']}: {numbers['summary']}"
    return None


def _told(error: Exception) -> str:
    """The error in one line, by the class of its cause."""
    cause = error.__cause__ if isinstance(error.__cause__, ConformalUVError) else error
    text = cause.told(Remedy.as_flag) if isinstance(cause, ConformalUVError) else str(cause)
    return f"{type(cause).__name__}: {' '.join(text.split())}"
