"""conformal-uv view: a surface and its map in a window, with checker and errors."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..charts import unwrap
from ..console.stages import Stages
from ..errors import MeshError, OptionError, Remedy
from ..files import check_distinct, check_place, read_mesh, read_seams, replaced_file
from ..mapped_mesh import AnyMap, mapped_mesh
from ..mesh import Surface
from ..mesh.polygons import PolygonMesh
from ..options import Choice, Closed, NonManifold, Orientation, Shape, Upright
from ..pictures.png import png
from ..show.libraries import library
from ..show.polyscope_scene import INSTALL
from ..show.polyscope_window import show_in_window, window_picture
from ..sphere import sphere_map
from .arguments import ClosedPieces, NonManifoldParts, Quiet, Seams, Source, UpAxis, Winding
from .compact import compact_triangles

__all__ = ["view"]


class ViewShape(Choice):
    """What the surface is mapped to."""

    AUTO = "auto"
    DISK = "disk"
    FREE = "free"
    RECTANGLE = "rectangle"
    SPHERE = "sphere"


def view(
    source: Source,
    shape: Annotated[
        ViewShape, typer.Option(help="What it is mapped to; auto: closed surfaces to the sphere, others to the disk.")
    ] = ViewShape.AUTO,
    screenshot: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write a PNG instead of opening a window.")
    ] = None,
    upright: UpAxis = Upright.Z,
    seams: Seams = None,
    closed: ClosedPieces = Closed.REFUSE,
    nonmanifold: NonManifoldParts = NonManifold.REFUSE,
    orientation: Winding = Orientation.REFUSE,
    format: Annotated[str | None, typer.Option(metavar="obj|ply|...", help="Of standard input (-).")] = None,
    quiet: Quiet = False,
) -> None:
    """Show a surface beside its map in a window: checker, angle error, area."""
    polyscope = library("polyscope", "view", INSTALL)
    if screenshot is not None:
        _check_screenshot(source, screenshot)
    with Stages(quiet=quiet) as stages:
        stages("read", 0.0)
        mesh_file = read_mesh(source, format=format)
        cut = read_seams(seams, mesh_file)
        result: AnyMap
        if shape is ViewShape.SPHERE or (shape is ViewShape.AUTO and _is_ball(mesh_file.mesh)):
            result = sphere_map(*compact_triangles(mesh_file.mesh), callback=stages)
        else:
            result = unwrap(
                None,
                mesh_file.mesh,
                shape=Shape.DISK if shape is ViewShape.AUTO else Shape(shape),
                seams=cut,
                upright=upright,
                closed=closed,
                nonmanifold=nonmanifold,
                orientation=orientation,
                callback=stages,
            )
            failure = result.failure(Remedy.as_flag)
            if failure is not None:
                raise failure
        mapped = mapped_mesh(result)
        if screenshot is not None:
            stages("draw", 0.0)
            picture = png(window_picture(polyscope, mapped, source.name, upright))
            with replaced_file(screenshot) as out:
                out.write(picture)
    if screenshot is None:
        show_in_window(polyscope, mapped, source.name, upright)


def _check_screenshot(source: Path, path: Path) -> None:
    if path.suffix.lower() != ".png":
        raise OptionError(f"--screenshot {path.name}: choose a file name that ends in .png.")
    check_distinct(source, {"--screenshot": path})
    check_place(path)


def _is_ball(mesh: PolygonMesh) -> bool:
    """Whether it is one closed surface without handles; what is no surface is not."""
    try:
        surface = Surface.from_arrays(*compact_triangles(mesh))
    except MeshError:
        return False
    return surface.pieces == 1 and not surface.loops and surface.genus == 0
