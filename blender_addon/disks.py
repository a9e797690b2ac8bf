"""Islands of objects that are maps onto a disk, slid together or one by itself; nothing is written here."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import bpy
import numpy as np
from numpy.typing import NDArray

from conformal_uv import DiskIsland, disk_islands

from .uv_objects import UVObject, folds_told, uv_objects
from .words import counted

NONE_FOUND = "no island of the active UV map is a disk, its boundary on a circle; unwrap with the shape Disk first"
NONE_SELECTED = "no disk is selected; select its faces, or put the cursor over it"
SMOOTH = 181  # points of a circle as it is drawn
LARGEST = 0.9995  # distance of a centre from the middle; farther out the rest is lost in single precision


@dataclass(frozen=True, eq=False)
class Disk:
    """One island, with the object it belongs to."""

    of: UVObject
    island: DiskIsland

    @property
    def ob(self) -> bpy.types.Object:
        """The object."""
        return self.of.ob

    @property
    def face(self) -> int:
        """A face of it, by which it is found again."""
        return int(self.island.faces[0])

    @property
    def selected(self) -> bool:
        """Whether one of its faces is."""
        return bool(self.of.selected[self.island.faces].any())

    def write(self, values: NDArray[np.float32], placed: NDArray[np.float64]) -> None:
        """Put the UVs (t, 2) of the island's UV vertices among those of all corners, (k, 2)."""
        values[self.island.corners] = placed.astype(np.float32).take(self.island.point, axis=0)


def find_disks(context: bpy.types.Context, objects: Iterable[bpy.types.Object]) -> list[Disk]:
    """All islands of visible faces that are disks."""
    return [
        Disk(read, island)
        for read in uv_objects(context, objects)
        for island in disk_islands(read.mesh, read.uv, read.visible)
    ]


def chosen_disks(disks: list[Disk], name: str = "", face: int = -1) -> list[Disk]:
    """The one with that face of the object of that name, or those that are selected."""
    if face < 0:
        return [disk for disk in disks if disk.selected]
    return [disk for disk in disks if disk.ob.name == name and face in disk.island.faces]


def disk_under(disks: list[Disk], uv: tuple[float, float]) -> Disk | None:
    """A disk that a point lies in, selected ones first."""
    within = [disk for disk in disks if disk.island.contains(uv)]
    return next((disk for disk in within if disk.selected), within[0] if within else None)


def by_object(disks: Iterable[Disk]) -> Iterator[tuple[bpy.types.Object, list[Disk]]]:
    """The disks of each object."""
    groups: dict[bpy.types.Object, list[Disk]] = {}
    for disk in disks:
        groups.setdefault(disk.ob, []).append(disk)
    yield from groups.items()


def slid(disks: list[Disk], values: dict[bpy.types.Object, NDArray[np.float32]]) -> str:
    """What was done, and whether faces folded that had not."""
    done = counted(len(disks), "Slid {count} disk", "Slid {count} disks")
    folded = 0
    for ob, group in by_object(disks):
        folded += group[0].of.newly_folded(values[ob], np.concatenate([disk.island.faces for disk in group]))
    return folds_told(done, folded)


def limited(z: complex) -> complex:
    """A point brought inside the disk, not closer to the circle than a centre may be."""
    size = abs(z)
    return z if size <= LARGEST else z * (LARGEST / size)


def in_disk(disk: Disk, uv: tuple[float, float]) -> complex:
    """A point of the UV map in the coordinates of the unit disk."""
    return complex(disk.island.place.to_disk(np.array([uv]))[0])


def in_uv(disk: Disk, z: complex) -> NDArray[np.float64]:
    """A point of the unit disk in the UV map, (2,)."""
    return disk.island.place.from_disk(np.array([z]))[0]


def circle(disk: Disk) -> NDArray[np.float64]:
    """The disk's boundary as a closed line, (k, 2)."""
    return disk.island.place.from_disk(np.exp(2j * np.pi * np.linspace(0.0, 1.0, SMOOTH)))
