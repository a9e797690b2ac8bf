"""The small charts of a mesh, mapped together in a few batches."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..atlas import AtlasMaps, DiskAtlas, Turns, places, sound_disks, takes
from ..errors import SolverError
from ..options import ChartOptions, Laplacian
from ..progress import Progress
from .chart_meshes import ChartMeshes
from .chart_progress import ChartProgress
from .upright import upright_turns

__all__ = ["ChartAtlas"]

Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Complex = NDArray[np.complex128]

FEWEST = 8  # charts for which it pays
MOST_FACES = 1000  # of a chart; larger ones are as fast one by one
MOST_BOUNDARY = 96  # vertices of a chart's boundary, which gets a matrix of its own
BATCH = 1 << 18  # faces that are worked on at a time


class ChartAtlas:
    """Charts that are mapped together, factorized when they are first mapped.

    Parameters
    ----------
    meshes : ChartMeshes
    sound : (c,) bool
        Charts with which nothing is wrong so far.
    laplacian : Laplacian
    backend : str
    """

    def __init__(self, meshes: ChartMeshes, sound: Bools, laplacian: Laplacian, backend: str) -> None:
        self._meshes, self._laplacian, self._backend = meshes, laplacian, backend
        self._small = sound & (meshes.weights() <= MOST_FACES)
        self._made: tuple[Ints, list[_Batch]] | None = None

    def maps(self, wanted: Bools, options: ChartOptions, told: ChartProgress) -> Iterator[AtlasMaps]:
        """The maps of the `wanted` charts (c,) to disks, a batch at a time; those that it leaves to others are not
        good, or missing."""
        chosen = np.flatnonzero(wanted & self._small)
        if len(chosen) < FEWEST or not takes(options.disk):
            return
        progress = Progress(told if told.wanted else None)
        for batch in self._batches(chosen, told, progress):
            yield batch.atlas.maps(options.disk, batch.turns(options), progress)

    def _batches(self, chosen: Ints, told: ChartProgress, progress: Progress) -> Iterator[_Batch]:
        """Of the chosen charts; kept for the next time if all went well."""
        if self._made is not None and np.array_equal(self._made[0], chosen):
            for batch in self._made[1]:
                told.start(batch.atlas.disks.number)
                yield batch
            return
        self._made, made = None, list[_Batch]()
        ends = np.cumsum(self._meshes.weights()[chosen])
        parts = np.split(chosen, np.flatnonzero(np.diff(ends // BATCH)) + 1)[::-1]
        while parts:
            part = parts.pop()
            told.start(part)
            try:
                found = self._batch(part, progress)
            except SolverError:  # one chart's fault; it is looked for by halves, and told where it is mapped alone
                parts += [half for half in np.array_split(part, 2)[::-1] if len(half) >= FEWEST]
                continue
            if found is not None:
                made.append(found)
                yield found
        self._made = chosen, made

    def _batch(self, part: Ints, progress: Progress) -> _Batch | None:
        """Some charts made ready; None where none of them is a disk beyond doubt."""
        meshes = self._meshes
        progress("checks", 0.0)
        disks = sound_disks(meshes.V, meshes.solved, meshes.first_vertex, meshes.first_solved, part, MOST_BOUNDARY)
        if disks is None:
            return None
        atlas = DiskAtlas(disks, self._laplacian, self._backend, progress)
        count = np.diff(meshes.first_face)[disks.number]
        chart = np.repeat(np.arange(len(disks)), count)
        F = meshes.F[places(meshes.first_face, disks.number)] + disks.first_vertex[chart][:, None]
        return _Batch(atlas, F, chart)


class _Batch(NamedTuple):
    """Charts that are mapped together; F (m, 3) are the triangles of their polygons, `chart` (m,) says whose."""

    atlas: DiskAtlas
    F: Ints
    chart: Ints

    def turns(self, options: ChartOptions) -> Turns:
        """What the disks are multiplied by to be upright and turned as asked for."""
        disks, rotation = self.atlas.disks, complex(np.exp(1j * options.rotation)) if options.rotation else 1.0

        def turns(z: Complex) -> Complex:
            first, upright = disks.first_vertex[:-1], options.shape.upright
            return rotation * upright_turns(disks.V, self.F, z, first, self.chart, upright)

        return turns
