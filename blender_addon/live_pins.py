"""Pins of UV islands dragged one after the other; what takes long is kept between drags. Nothing is written here."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from hashlib import blake2b

import bpy
import numpy as np
from numpy.typing import NDArray

from conformal_uv import (
    DiskIsland,
    IslandSurface,
    PinDrag,
    PinnedMapper,
    UVIslands,
    disk_islands,
    island_surface,
    uv_islands,
)

from .image_aspect import aspect_scale
from .uv_objects import UVObject, folds_told
from .words import counted

NO_PINS = "no selected island has two pinned UVs or more; select UVs and press P to pin them"
NO_HANDLE = "there is no pinned UV, and no selected one on the boundary of an island, to drag"
NO_HANDLE_HERE = "there is no pinned UV, and no selected one on the boundary of an island, to drag here"
MOST_KEPT = 4
FEWEST = 2

_kept: dict[bytes, PinnedMapper] = {}


def forget() -> None:
    """Drop all factorizations."""
    _kept.clear()


@dataclass(frozen=True)
class Handle:
    """A UV vertex that can be dragged: its object's place in the list, its number, a corner of it."""

    owner: int
    point: int
    corner: int


class PinnedObject:
    """An object's UV map while pins of it are dragged.

    Attributes
    ----------
    uv : (t, 2) float64
        The UV vertices as they are now.
    """

    def __init__(self, read: UVObject) -> None:
        self.read = read
        self.islands: UVIslands = uv_islands(read.mesh, read.uv, read.visible)
        self.uv = self.islands.uv.copy()
        self.scale = aspect_scale(read.ob)
        self._pinned = np.zeros(len(self.uv), dtype=bool)
        self._pinned[self.islands.point[read.pinned]] = True
        self._island_of_point = self.islands.island_of_points(read.mesh)
        self._pinned &= self._island_of_point >= 0

    @cached_property
    def handles(self) -> NDArray[np.int64]:
        """UV vertices that can be dragged: pinned ones, and selected ones of a boundary."""
        picked = np.zeros(len(self.uv), dtype=bool)
        picked[self.islands.point[self.read.picked & self.read.selected[self.read.corner_face]]] = True
        return np.flatnonzero(self._pinned | (picked & self.islands.rim))

    @property
    def pinned(self) -> NDArray[np.int64]:
        """Pinned UV vertices."""
        return np.flatnonzero(self._pinned)

    def corner_of(self, point: int) -> int:
        """A corner with this UV vertex."""
        return int(np.flatnonzero(self.islands.point == point)[0])

    def has(self, corner: int) -> bool:
        """Whether there is such a corner, of a visible face."""
        return 0 <= corner < len(self.islands.point) and bool(self.read.visible[self.read.corner_face[corner]])

    def pinned_islands(self) -> list[int]:
        """Islands with a selected face and two pins or more."""
        count = np.bincount(self._island_of_point[self._pinned], minlength=self.islands.count)
        selected = np.zeros(self.islands.count, dtype=bool)
        selected[self.islands.island[self.read.selected]] = True
        return np.flatnonzero(selected & (count >= FEWEST)).tolist()

    def first_pin(self, island: int) -> int:
        """A pinned UV vertex of an island that has one."""
        return int(np.flatnonzero(self._pinned & (self._island_of_point == island))[0])

    def drag(self, point: int) -> IslandDrag:
        """A UV vertex taken hold of; the islands' other pins stay, and where there is none the point farthest off.

        Raises
        ------
        ConformalUVError
            The island can not be mapped.
        """
        number = int(self._island_of_point[point])
        islands = replace(self.islands, uv=self.uv)
        surface = island_surface(self.read.mesh, islands, number, self.scale)
        moved = int(np.searchsorted(surface.numbers, point))
        pins = np.union1d(np.flatnonzero(self._pinned[surface.numbers]), [moved])
        if len(pins) < FEWEST:
            pins = np.union1d(pins, [surface.farthest(moved)])
        disk = self._disk(number) if self._pinned[point] else None
        key = _digest(surface, pins)
        drag = PinDrag(surface, pins, moved, disk=disk, mapper=_kept.get(key))
        if drag.mapper is not None:
            _kept[key] = drag.mapper
            while len(_kept) > MOST_KEPT:
                del _kept[next(iter(_kept))]
        return IslandDrag(self, surface, drag, len(pins))

    def _disk(self, number: int) -> DiskIsland | None:
        corner_uv = self.uv[self.islands.point]
        found = disk_islands(self.read.mesh, corner_uv, self.islands.island == number)
        return found[0] if found else None


@dataclass(frozen=True, eq=False)
class IslandDrag:
    """One island following a pin.

    Attributes
    ----------
    of : PinnedObject
    surface : IslandSurface
    drag : PinDrag
    pins : int
        How many hold the island, the dragged one included.
    """

    of: PinnedObject
    surface: IslandSurface
    drag: PinDrag
    pins: int

    @property
    def ob(self) -> bpy.types.Object:
        """The object."""
        return self.of.read.ob

    @property
    def kind(self) -> str:
        """What the island is while it follows."""
        return "disk" if self.drag.mapper is None else "free"

    def move(self, values: NDArray[np.float32], place: tuple[float, float]) -> None:
        """Bring the pin to a place, and the island's UVs among those of all corners, (k, 2)."""
        placed = self.drag.placed(place)
        self.of.uv[self.surface.numbers] = placed
        values[self.surface.corners] = placed.astype(np.float32).take(self.surface.point, axis=0)


def nearest(owners: list[PinnedObject], at: tuple[float, float], reach: float) -> Handle | None:
    """The handle nearest to a place, within reach."""
    best, found = reach, None
    for number, owner in enumerate(owners):
        if not len(owner.handles):
            continue
        distance = np.hypot(*(owner.uv[owner.handles] - at).T)
        closest = int(np.argmin(distance))
        if distance[closest] <= best:
            best, point = float(distance[closest]), int(owner.handles[closest])
            found = Handle(number, point, owner.corner_of(point))
    return found


def mapped(drags: list[IslandDrag], values: dict[bpy.types.Object, NDArray[np.float32]]) -> str:
    """What was done, and whether faces folded that had not."""
    islands = {(drag.ob, int(drag.surface.faces[0])): drag for drag in drags}
    folded = sum(drag.of.read.newly_folded(values[drag.ob], drag.surface.faces) for drag in islands.values())
    done = counted(len(islands), "Mapped {count} island from pins", "Mapped {count} islands from pins")
    return folds_told(done, folded)


def _digest(surface: IslandSurface, pins: NDArray[np.int64]) -> bytes:
    """A fingerprint of what a factorization depends on."""
    hashed = blake2b(digest_size=20)
    for array in (surface.V, surface.F, pins):
        hashed.update(str(array.shape).encode())
        hashed.update(np.ascontiguousarray(array).data)
    return hashed.digest()
