"""conformal-uv report: what a mesh is, whether it can be mapped, and how distorted the UVs are that it has."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from ..console.stages import Stages
from ..console.summary import distortion_summary, print_rows
from ..errors import MeshError
from ..files import MeshFile, read_mesh
from ..mesh import Surface
from ..mesh.triangulate import triangulate
from ..operators.laplacian import cotangent_weights
from ..report import distortion_numbers
from .outputs import Outputs
from .texture import texture_of

__all__ = ["report"]


def report(
    source: Annotated[Path, typer.Argument(metavar="IN", help="Mesh: OBJ, PLY, OFF, STL, NPZ, GLB ...")],
    format: Annotated[str | None, typer.Option(metavar="obj|ply|...", help="Of standard input (-).")] = None,
    json_file: Annotated[Path | None, typer.Option("--json", metavar="FILE", help="Write all numbers.")] = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No table.")] = False,
) -> None:
    """Tell what a mesh is: its topology, angles, weights, and the distortion of its UVs."""
    outputs = Outputs(source, json=json_file)
    outputs.check()
    with Stages(quiet=True):
        mesh_file = read_mesh(source, format=format)
    F, _, _ = triangulate(mesh_file.mesh)
    summary: dict[str, Any] = {
        "input": str(source),
        "vertices": len(mesh_file.mesh.V),
        "faces": len(mesh_file.mesh.sizes),
        "triangles": len(F),
    }
    try:
        summary.update(_surface_summary(Surface.from_arrays(mesh_file.mesh.V, F)))
    except MeshError as error:
        summary["not_a_surface"] = f"{type(error).__name__}: {error}"
    summary["uv"] = _uv_summary(mesh_file)
    outputs.write_numbers(summary)
    if not quiet:
        _print(summary, stderr=outputs.on_stdout)


def _surface_summary(surface: Surface) -> dict[str, Any]:
    geometry = surface.geometry
    angles = np.degrees(np.arctan2(geometry.double_area, geometry.dot))
    with np.errstate(divide="ignore", invalid="ignore"):  # faces without area
        weights = cotangent_weights(surface.edges, geometry)[surface.edges.count == 2]
    try:
        surface.require_disk()
        kind = "disk"
    except MeshError as error:
        kind = str(error)
    return {
        "edges": len(surface.edges.lo),
        "pieces": surface.pieces,
        "genus": surface.genus,
        "euler_characteristic": surface.euler_characteristic,
        "boundary_loops": [
            {"vertices": len(loop), "length": surface.loop_length(loop) * surface.unit} for loop in surface.loops
        ],
        "area": float(0.5 * geometry.double_area.sum() * surface.unit * surface.unit),
        "angle_degrees": {"min": float(angles.min()), "max": float(angles.max())},
        "negative_weights": int((weights < 0).sum()),
        "interior_edges": len(weights),
        "topology": kind,
    }


def _uv_summary(mesh_file: MeshFile) -> dict[str, Any] | None:
    """Distortion of the file's own UVs over the faces that have them and have area."""
    texture = texture_of(mesh_file)
    if texture is None:
        return None
    return {
        "triangles": len(texture.corners),
        **distortion_summary(distortion_numbers([texture.distortion])),
        "flipped_faces": len(texture.distortion.flipped),
    }


def _print(summary: dict[str, Any], *, stderr: bool) -> None:
    counts = f"{summary['vertices']} vertices, {summary['faces']} faces"
    if summary["triangles"] != summary["faces"]:
        counts += f" ({summary['triangles']} triangles)"
    rows = [("mesh", counts)]
    if "not_a_surface" in summary:
        rows.append(("problem", summary["not_a_surface"]))
    else:
        rows += _surface_rows(summary)
    uv = summary["uv"]
    told = "none"
    if uv is not None:
        told = "angle error mean {mean:.4g}, sd {sd:.4g}, max {max:.4g} degrees; ".format(**uv["angle_error_degrees"])
        told += f"{uv['flipped_faces']} of {uv['triangles']} triangles flipped"
    rows.append(("UVs", told))
    print_rows(rows, stderr=stderr)


def _surface_rows(summary: dict[str, Any]) -> list[tuple[str, str]]:
    loops = summary["boundary_loops"]
    told = [f"{loop['vertices']} vertices (length {loop['length']:.4g})" for loop in loops[:6]]
    told += ["..."] if len(loops) > 6 else []
    return [
        ("topology", summary["topology"]),
        ("pieces", f"{summary['pieces']}, genus {summary['genus']}"),
        ("boundary loops", f"{len(loops)}: {', '.join(told)}" if loops else "none"),
        ("area", f"{summary['area']:.6g}"),
        ("angles", "{min:.4g} to {max:.4g} degrees".format(**summary["angle_degrees"])),
        ("negative weights", f"{summary['negative_weights']} of {summary['interior_edges']} interior edges"),
    ]
