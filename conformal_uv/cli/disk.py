"""conformal-uv disk: surfaces onto the unit disk."""

from __future__ import annotations

from typing import Annotated

import typer

from ..options import (
    Backend,
    Balance,
    Closed,
    DistributedSolver,
    Holes,
    Laplacian,
    MarginMethod,
    Method,
    NonManifold,
    Objective,
    Orientation,
    PackRotation,
    PackShape,
    PinMode,
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
from .numbers import three_numbers
from .unwrapping import unwrap_file

__all__ = ["disk"]


def disk(
    source: Source,
    target: Target,
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
    balance: Annotated[Balance, typer.Option(help="What is at 0 without a center and pins.")] = Balance.MIDDLE,
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
    solver: Annotated[
        DistributedSolver, typer.Option(help="Of --backend petsc, which maps one surface spread over MPI processes.")
    ] = DistributedSolver.AUTO,
    split: Split = False,
    format: MeshFormat = None,
    json_file: JsonFile = None,
    plot: PictureFile = None,
    html_file: PageFile = None,
    quiet: Quiet = False,
) -> None:
    """Map surfaces with disk topology onto the unit disk.

    One surface fills the unit square of texture space: u, v = 0.5 + 0.5 (x, y). Several charts (pieces, or parts
    between seams) are packed into it.

    With mpiexec -n N and --backend petsc, each process reads, maps and writes its rows of one surface in an NPZ
    archive.
    """
    if backend is Backend.PETSC:
        from .giant import map_giant  # MPI starts when it is imported

        map_giant(
            source,
            target,
            json_file,
            quiet,
            {
                "--pin-mode constraint": pin_mode is PinMode.CONSTRAINT,
                "--balance area": balance is not Balance.MIDDLE,
                "--seams": seams is not None,
                "--closed cut": closed is not Closed.REFUSE,
                "--nonmanifold cut": nonmanifold is not NonManifold.REFUSE,
                "--orientation mend": orientation is not Orientation.REFUSE,
                "--place": place is not Place.FIT,
                "--margin": margin is not None,
                "--margin-method": margin_method is not MarginMethod.BETWEEN,
                "--image-size": image_size != PlaceOptions.image_size,
                "--pack-rotation": pack_rotation is not PackRotation.NONE,
                "--pack-shape": pack_shape is not PackShape.OUTLINE,
                "--keep-scale": keep_scale,
                "--tile": tile != PlaceOptions.tile,
                "--split": split,
                "--format": format is not None,
                "--plot": plot is not None,
                "--html": html_file is not None,
            },
            method=method,
            objective=objective,
            pins=three_numbers(pins),
            center=center,
            boundary_vertex=boundary_vertex,
            upright="none" if pins is not None or boundary_vertex is not None else upright,
            laplacian=laplacian,
            repair=repair,
            solver=solver,
        )
        return
    unwrap_file(
        Shape.DISK,
        source=source,
        target=target,
        method=method,
        objective=objective,
        pins=three_numbers(pins),
        pin_mode=pin_mode,
        center=center,
        boundary_vertex=boundary_vertex,
        balance=balance,
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
