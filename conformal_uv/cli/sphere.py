"""conformal-uv sphere: a closed mesh in, its conformal image on the unit sphere out."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from .._version import __version__
from ..batches.sphere_file import sphere_file, stored_sphere
from ..console.stages import Stages
from ..console.summary import angles_text, distortion_summary, iterations_text, print_rows
from ..files import read_mesh, write_mesh
from ..options import Backend, Laplacian, Normalization, Repair, Rotation, SphereBoundary, SphereLayout, SphereMethod
from ..page import write_page
from ..pictures.figure import draw_map
from ..report import distortion_numbers
from ..sphere import SphereMap
from .arguments import PageFile
from .numbers import three_numbers
from .outputs import Outputs

__all__ = ["sphere"]


def sphere(
    source: Annotated[Path, typer.Argument(metavar="IN", help="Closed mesh: OBJ, PLY, OFF, STL, NPZ, GLB ...")],
    target: Annotated[Path, typer.Argument(metavar="OUT", help="Mesh on the unit sphere: OBJ, PLY or NPZ.")],
    method: Annotated[SphereMethod, typer.Option(help="How the map is found.")] = SphereMethod.AUTO,
    normalization: Annotated[
        Normalization, typer.Option(help="What is brought to the middle of the ball.")
    ] = Normalization.AREA,
    rotation: Annotated[Rotation, typer.Option(help="How the sphere is turned.")] = Rotation.PRINCIPAL,
    landmarks: Annotated[
        str | None,
        typer.Option(metavar="A,B,C", help="Vertices (from 0) sent to the south pole, (1, 0, 0) and the north pole."),
    ] = None,
    boundary: Annotated[SphereBoundary, typer.Option(help="Boundary loops; a cap is virtual.")] = SphereBoundary.REFUSE,
    laplacian: Annotated[Laplacian, typer.Option(help="Weights.")] = Laplacian.AUTO,
    repair: Annotated[Repair, typer.Option(help="Inverted triangles.")] = Repair.AUTO,
    backend: Annotated[Backend, typer.Option(help="Factorization library.")] = Backend.AUTO,
    uv: Annotated[SphereLayout, typer.Option(help="UVs to write.")] = SphereLayout.NONE,
    split: Annotated[bool, typer.Option("--split", help="Write vertices split at the seams of the UVs.")] = False,
    format: Annotated[
        str | None, typer.Option(metavar="obj|ply|npz", help="Of standard input and output (-); by default obj.")
    ] = None,
    json_file: Annotated[Path | None, typer.Option("--json", metavar="FILE", help="Write all numbers.")] = None,
    plot: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Draw the surface and its sphere in the same colours.")
    ] = None,
    html_file: PageFile = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress bar and no table.")] = False,
) -> None:
    """Map a closed surface of genus 0 onto the unit sphere.

    OUT has the faces of IN and the positions on the sphere; its UVs are those of --uv, if any.
    """
    marks = three_numbers(landmarks)
    outputs = Outputs(source, target, json_file, plot, html_file, format)
    outputs.check()
    with Stages(quiet=quiet) as stages:
        stages("read", 0.0)
        mesh = read_mesh(source, format=format).mesh
        result = sphere_file(
            mesh,
            method=method,
            normalization=normalization,
            rotation=rotation,
            landmarks=marks,
            boundary=boundary,
            laplacian=laplacian,
            repair=repair,
            backend=backend,
            callback=stages,
        )
        stages("distortion", 0.0)
        summary = _summary(result, str(source), str(target), stages.seconds)
        image, corner_uv = stored_sphere(result, mesh, uv, target)
        outputs.write(
            stages,
            summary,
            lambda path: write_mesh(path, image, corner_uv=corner_uv, split=split, format=format),
            lambda path: draw_map(path, result, source.name),
            lambda path: write_page(path, result, source.name),
        )
    if not quiet:
        _print(summary, stderr=outputs.on_stdout)


def _summary(result: SphereMap, source: str, target: str, seconds: dict[str, float]) -> dict[str, Any]:
    return {
        "conformal_uv": __version__,
        "input": source,
        "output": target,
        "mesh": {"vertices": result.surface.n, "triangles": result.surface.m},
        "method": result.method,
        "normalization": result.normalization,
        "laplacian": result.laplacian,
        "converged": result.converged,
        "iterations": len(result.history),
        "history": [row._asdict() for row in result.history],
        "conformal_energy": result.conformal_energy,
        "dirichlet_energy": result.dirichlet_energy,
        "signed_volume": result.signed_volume,
        **distortion_summary(distortion_numbers([result.distortion])),
        "flipped_faces": len(result.flipped),
        "repaired_faces": result.repaired,
        "seconds": seconds,
    }


def _print(summary: dict[str, Any], *, stderr: bool) -> None:
    mesh = summary["mesh"]
    print_rows(
        [
            ("mesh", f"{mesh['vertices']} vertices, {mesh['triangles']} triangles"),
            ("method", "{method}, {laplacian} Laplacian, centred by {normalization}".format(**summary)),
            ("iterations", iterations_text(summary)),
            ("conformal energy", f"{summary['conformal_energy']:.6g}"),
            ("angle error", angles_text(summary["angle_error_degrees"])),
            ("flipped faces", "{flipped_faces} ({repaired_faces} repaired)".format(**summary)),
            ("seconds", ", ".join(f"{stage} {spent:.2f}" for stage, spent in summary["seconds"].items())),
            ("output", summary["output"]),
        ],
        stderr=stderr,
    )
