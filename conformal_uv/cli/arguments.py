"""What several commands take, each said once."""

from __future__ import annotations

from pathlib import Path
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
    Repair,
    Upright,
)

__all__ = [
    "BackendName",
    "ClosedPieces",
    "FoldedFaces",
    "HoleLoops",
    "ImageSize",
    "JsonFile",
    "KeepScale",
    "MarginMeaning",
    "MeshFormat",
    "NonManifoldParts",
    "PackedShape",
    "PackedTurns",
    "PageFile",
    "PictureFile",
    "PlaceInSquare",
    "Quiet",
    "Seams",
    "Source",
    "Split",
    "SquareMargin",
    "Target",
    "UdimTile",
    "UpAxis",
    "Weights",
    "Winding",
]

Source = Annotated[Path, typer.Argument(metavar="IN", help="Mesh: OBJ, PLY, OFF, STL, NPZ, GLB ...; - is stdin.")]
Target = Annotated[Path, typer.Argument(metavar="OUT", help="Mesh with UVs: OBJ, PLY or NPZ; - is stdout.")]

UpAxis = Annotated[Upright, typer.Option(help="Axis of the surface that points up in the texture.")]
Seams = Annotated[
    str | None,
    typer.Option(metavar="FILE|uv", help="Edges to cut along: lines of two vertices, or where UVs are torn."),
]
HoleLoops = Annotated[Holes, typer.Option(help="Boundary loops but the longest.")]
ClosedPieces = Annotated[Closed, typer.Option(help="Closed pieces and handles.")]
NonManifoldParts = Annotated[NonManifold, typer.Option(help="Edges of three faces, pieces that touch in a vertex.")]
Winding = Annotated[Orientation, typer.Option(help="Faces wound against their neighbours.")]
Weights = Annotated[Laplacian, typer.Option(help="Weights.")]
FoldedFaces = Annotated[Repair, typer.Option(help="Folded triangles.")]
PlaceInSquare = Annotated[Place, typer.Option(help="Placing in the unit square.")]
SquareMargin = Annotated[
    float | None,
    typer.Option(metavar="M", help="Least distance between charts and to the square's sides, a part of its side."),
]
MarginMeaning = Annotated[
    MarginMethod,
    typer.Option(help="What the margin is: between charts; or around each, as in Blender, or in pixels of an image."),
]
ImageSize = Annotated[int, typer.Option(metavar="N", help="Pixels of the image's side, for --margin-method pixels.")]
PackedTurns = Annotated[PackRotation, typer.Option(help="How charts may be turned to be packed.")]
PackedShape = Annotated[PackShape, typer.Option(help="What of a chart is packed.")]
KeepScale = Annotated[
    bool, typer.Option("--keep-scale", help="Charts have the size of their surface, and are not scaled to the square.")
]
UdimTile = Annotated[int, typer.Option(metavar="1001...", help="Tile of the texture (UDIM); 1001 is the unit square.")]
BackendName = Annotated[Backend, typer.Option(help="Factorization library.")]

Split = Annotated[
    bool, typer.Option("--split", help="Write vertices split at seams, for programs that know one UV a vertex.")
]
MeshFormat = Annotated[
    str | None, typer.Option(metavar="obj|ply|npz", help="Of standard input and output (-); by default obj.")
]
JsonFile = Annotated[Path | None, typer.Option("--json", metavar="FILE", help="Write all numbers.")]
PictureFile = Annotated[
    Path | None, typer.Option(metavar="FILE", help="Draw the surface, the flattened mesh and its angle error.")
]
PageFile = Annotated[
    Path | None, typer.Option("--html", metavar="FILE", help="Write a web page: the surface beside its map, by hand.")
]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No progress bar and no table.")]
