"""The small charts of a mesh, mapped together in a few batches."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..atlas import (
    DiskAtlas,
    DiskMaps,
    FactorizedDisks,
    Frames,
    FreeAtlas,
    FreeMaps,
    Turns,
    neighbours,
    places,
    sound_disks,
    takes,
    takes_free,
)
from ..errors import SolverError
from ..options import ChartOptions, Laplacian, Shape
from ..progress import Progress
from .chart_meshes import ChartMeshes
from .chart_progress import ChartProgress
from .upright import straight_sides, upright_turns

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

    def maps(
        self, wanted: Bools, shape: Shape, options: ChartOptions, told: ChartProgress
    ) -> Iterator[DiskMaps | FreeMaps]:
        """The maps of the `wanted` charts (c,) to disks or with free boundaries, a batch at a time; those that it
        leaves to others are not good, or missing."""
        chosen = np.flatnonzero(wanted & self._small)
        taken = takes(options.disk) if shape is Shape.DISK else shape is Shape.FREE and takes_free(options.free)
        if len(chosen) < FEWEST or not taken:
            return
        progress = Progress(told if told.wanted else None)
        for batch in self._batches(chosen, told, progress):
            try:
                yield batch.maps(shape, options, progress)
            except SolverError:  # of a copy with split chords
                continue

    def _batches(self, chosen: Ints, told: ChartProgress, progress: Progress) -> Iterator[_Batch]:
        """Of the chosen charts; kept for the next time if all went well."""
        if self._made is not None and np.array_equal(self._made[0], chosen):
            for batch in self._made[1]:
                told.start(batch.disks.number)
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
        factorized = FactorizedDisks(disks, self._laplacian, self._backend, progress)
        count = np.diff(meshes.first_face)[disks.number]
        chart = np.repeat(np.arange(len(disks)), count)
        F = meshes.F[places(meshes.first_face, disks.number)] + disks.first_vertex[chart][:, None]
        own = meshes.first_virtual[disks.number] - meshes.first_vertex[disks.number]
        virtual = np.arange(disks.n) - disks.first_vertex[disks.of_vertex] >= own[disks.of_vertex]
        return _Batch(factorized, F, chart, virtual)


class _Batch:
    """Charts that are mapped together; F (m, 3) are the triangles of their polygons, `chart` (m,) says whose, `virtual`
    (n,) which vertices are none of theirs."""

    def __init__(self, factorized: FactorizedDisks, F: Ints, chart: Ints, virtual: Bools) -> None:
        self.disks = factorized.disks
        self._factorized, self._F, self._chart, self._virtual = factorized, F, chart, virtual
        self._disk: DiskAtlas | None = None
        self._free: FreeAtlas | None = None

    def maps(self, shape: Shape, options: ChartOptions, progress: Progress) -> DiskMaps | FreeMaps:
        """The maps of one shape."""
        if shape is Shape.FREE:
            self._free = self._free or FreeAtlas(self._factorized)
            return self._free.maps(self._frames(options), progress)
        self._disk = self._disk or DiskAtlas(self._factorized, progress)
        return self._disk.maps(options.disk, self._turns(options), progress)

    def _turns(self, options: ChartOptions) -> Turns:
        """What the disks are multiplied by to be upright and turned as asked for."""
        disks, rotation = self.disks, complex(np.exp(1j * options.rotation)) if options.rotation else 1.0

        def turns(z: Complex) -> Complex:
            first, upright = disks.first_vertex[:-1], options.shape.upright
            return rotation * upright_turns(disks.V, self._F, z, first, self._chart, upright)

        return turns

    def _frames(self, options: ChartOptions) -> Frames:
        """Flat charts upright, turned as asked for, and in the middle of the square that they fill one way."""
        disks, rotation = self.disks, complex(np.exp(1j * options.rotation)) if options.rotation else 1.0
        first, upright = disks.first_vertex[:-1], options.shape.upright
        ahead, _ = neighbours(disks.first_boundary)

        def frames(z: Complex) -> Complex:
            edges = z[disks.loop[ahead]] - z[disks.loop]
            sides = straight_sides(edges, disks.of_boundary, len(disks))
            turn = rotation * upright_turns(disks.V, self._F, z, first, self._chart, upright, sides)
            z = z * turn[disks.of_vertex]
            own = np.where(self._virtual, np.nan, 1.0)
            low = np.fmin.reduceat(own * z.real, first) + 1j * np.fmin.reduceat(own * z.imag, first)
            high = np.fmax.reduceat(own * z.real, first) + 1j * np.fmax.reduceat(own * z.imag, first)
            side = np.maximum((high - low).real, (high - low).imag)
            scale = np.where(side > 0.0, 2.0 / np.where(side > 0.0, side, 1.0), 1.0)
            z = (z - (0.5 * (low + high))[disks.of_vertex]) * scale[disks.of_vertex]
            return np.clip(z.real, -1.0, 1.0) + 1j * np.clip(z.imag, -1.0, 1.0)

        return frames
