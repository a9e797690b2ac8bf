"""conformal-uv free: surfaces laid into the plane with a boundary that takes its own shape."""

from __future__ import annotations

from typing import Annotated

import typer

from ..options import (
    Backend,
    Closed,
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
from .unwrapping import unwrap_file

__all__ = ["free"]


def free(
    source: Source,
    target: Target,
    refine: Annotated[
        bool, typer.Option("--refine", help="Move all vertices to a smaller angle error, where there is one.")
    ] = False,
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
    """Lay surfaces with disk topology into the plane, each with its own outline.

    What can be unrolled comes out unrolled, its lengths kept up to one scale. One surface fills the unit square of
    texture space one way; several charts are packed into it by their outlines.
    """
    unwrap_file(
        Shape.FREE,
        source=source,
        target=target,
        refine=refine,
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
