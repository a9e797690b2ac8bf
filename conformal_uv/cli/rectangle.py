"""conformal-uv rectangle: surfaces onto rectangles."""

from __future__ import annotations

from typing import Annotated

import typer

from ..options import (
    Backend,
    Closed,
    CornerChoice,
    Holes,
    Laplacian,
    MarginMethod,
    NonManifold,
    Orientation,
    PackRotation,
    PackShape,
    Place,
    PlaceOptions,
    Repair,
    Shape,
    Upright,
)
from .arguments import (
    BackendName,
    ClosedPieces,
    FoldedFaces,
    HoleLoops,
    ImageSize,
    JsonFile,
    KeepScale,
    MarginMeaning,
    MeshFormat,
    NonManifoldParts,
    PackedShape,
    PackedTurns,
    PageFile,
    PictureFile,
    PlaceInSquare,
    Quiet,
    Seams,
    Source,
    Split,
    SquareMargin,
    Target,
    UdimTile,
    UpAxis,
    Weights,
    Winding,
)
from .numbers import four_numbers
from .unwrapping import unwrap_file

__all__ = ["rectangle"]


def rectangle(
    source: Source,
    target: Target,
    corners: Annotated[
        str | None,
        typer.Option(metavar="A,B,C,D", help="Boundary vertices (from 0), along the boundary, that become corners."),
    ] = None,
    corner_choice: Annotated[
        CornerChoice,
        typer.Option(help="Of corners not given: where the boundary turns most, or the least change of area."),
    ] = CornerChoice.TURNING,
    upright: UpAxis = Upright.Z,
    seams: Seams = None,
    holes: HoleLoops = Holes.FILL,
    closed: ClosedPieces = Closed.REFUSE,
    nonmanifold: NonManifoldParts = NonManifold.REFUSE,
    orientation: Winding = Orientation.REFUSE,
    laplacian: Weights = Laplacian.AUTO,
    repair: FoldedFaces = Repair.AUTO,
    place: PlaceInSquare = Place.FIT,
    margin: SquareMargin = None,
    margin_method: MarginMeaning = MarginMethod.BETWEEN,
    image_size: ImageSize = PlaceOptions.image_size,
    pack_rotation: PackedTurns = PackRotation.NONE,
    pack_shape: PackedShape = PackShape.OUTLINE,
    keep_scale: KeepScale = False,
    tile: UdimTile = PlaceOptions.tile,
    backend: BackendName = Backend.AUTO,
    split: Split = False,
    format: MeshFormat = None,
    json_file: JsonFile = None,
    plot: PictureFile = None,
    html_file: PageFile = None,
    quiet: Quiet = False,
) -> None:
    """Map surfaces with disk topology onto rectangles, their boundary exactly onto the sides.

    How long the rectangle is for its width, its modulus, follows from the surface and the corners. One surface fills
    the unit square of texture space one way; several charts are packed into it.
    """
    unwrap_file(
        Shape.RECTANGLE,
        source=source,
        target=target,
        pins=four_numbers(corners),
        corner_choice=corner_choice,
        upright=upright,
        seams=seams,
        holes=holes,
        closed=closed,
        nonmanifold=nonmanifold,
        orientation=orientation,
        laplacian=laplacian,
        repair=repair,
        place=place,
        margin=margin,
        margin_method=margin_method,
        image_size=image_size,
        pack_rotation=pack_rotation,
        pack_shape=pack_shape,
        keep_scale=keep_scale,
        tile=tile,
        backend=backend,
        split=split,
        format=format,
        json_file=json_file,
        plot=plot,
        html_file=html_file,
        quiet=quiet,
    )
