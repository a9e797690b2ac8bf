"""conformal-uv sample: write a generated surface to try the maps on."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray

from .. import samples
from ..console.terminal import plain
from ..files import MeshFile, write_mesh
from ..mesh.polygons import PolygonMesh
from .outputs import Outputs

__all__ = ["sample"]


MOST_VERTICES = 50_000_000


class SampleChoice(StrEnum):
    """Names of the surfaces."""

    MASK = "mask"
    TERRAIN = "terrain"
    SPHERICAL_CAP = "spherical-cap"
    FLAT_DISK = "flat-disk"


Maker = Callable[..., tuple[NDArray[np.float64], NDArray[np.int32]]]

MAKERS: dict[SampleChoice, Maker] = {
    SampleChoice.MASK: samples.mask,
    SampleChoice.TERRAIN: samples.terrain,
    SampleChoice.SPHERICAL_CAP: samples.spherical_cap,
    SampleChoice.FLAT_DISK: samples.flat_disk,
}


def sample(
    kind: Annotated[SampleChoice, typer.Argument(help="The surface.")],
    target: Annotated[Path, typer.Argument(metavar="OUT", help="OBJ, PLY or NPZ.")],
    vertices: Annotated[int, typer.Option(min=16, max=MOST_VERTICES, help="Number of vertices, about.")] = 20000,
    seed: Annotated[int, typer.Option(min=0, help="Of the irregular triangulation.")] = 0,
    format: Annotated[str | None, typer.Option(metavar="obj|ply|npz", help="Of standard output (-).")] = None,
) -> None:
    """Write a generated surface."""
    outputs = Outputs(mesh=target, format=format)
    outputs.check()
    V, F = MAKERS[kind](vertices, seed=seed)
    corners = F.reshape(-1).astype(np.int64)
    mesh = PolygonMesh(V, corners, np.arange(0, len(corners) + 1, 3, dtype=np.int64))
    write_mesh(target, MeshFile(target, mesh), corner_uv=np.full((len(corners), 2), np.nan), format=format)
    typer.echo(plain(f"{target}: {len(V)} vertices, {len(F)} triangles"), err=outputs.on_stdout)
