"""A pin of an island dragged while the others stay, and the rest of the island following it, angles kept.

Where three pins lie on the circle of a disk the Moebius map that brings them to their places is the answer, and
the island stays a disk. Else it is the least squares conformal map with the pins at their places.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import OptionError
from ..free import PinnedMapper
from ..operators.moebius import Moebius
from .disk_islands import DiskIsland
from .island_surface import IslandSurface

__all__ = ["PinDrag"]

APART = 1e-3  # radians between a dragged pin on the circle and its neighbours: they may not change places
ON_CIRCLE = 3  # pins that fix a map of the disk


class PinDrag:
    """The island for every place of one pin; whatever takes long is done here, once.

    Parameters
    ----------
    surface : IslandSurface
        The pins' places are those of its UVs.
    pins : (p,) integers
        Two or more of its UV vertices.
    moved : int
        The one of them that is dragged.
    disk : DiskIsland, optional
        The same island, where it is a disk.
    mapper : PinnedMapper, optional
        The surface factorized for these pins, in this order, where that is at hand.

    Attributes
    ----------
    mapper : PinnedMapper or None
        None where three pins move a disk.

    Raises
    ------
    MeshError, OptionError, SolverError
        As `PinnedMapper` and its `map`.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> mesh = cuv.PolygonMesh(np.eye(3), np.array([0, 1, 2]), np.array([0, 3]))
    >>> surface = cuv.island_surface(mesh, cuv.uv_islands(mesh, [[0, 0], [1, 0], [0, 1]]), 0)
    >>> cuv.PinDrag(surface, [0, 1], moved=1).placed([0, 2])[1].tolist()
    [0.0, 2.0]
    """

    def __init__(
        self,
        surface: IslandSurface,
        pins: ArrayLike,
        moved: int,
        *,
        disk: DiskIsland | None = None,
        mapper: PinnedMapper | None = None,
    ) -> None:
        self._surface, self._pins = surface, np.asarray(pins, dtype=np.int64)
        if moved not in self._pins:
            raise OptionError(f"The pin to be moved, {moved}, is not among the pins {self._pins.tolist()}.")
        self._number = int(np.flatnonzero(self._pins == moved)[0])
        self._disk = disk if disk is not None and _three_on_circle(disk, self._pins) else None
        self.mapper = None
        if self._disk is None:
            self.mapper = mapper or PinnedMapper(surface.V, surface.F, self._pins)
            self._start = surface.uv[moved]
            self._uv = self.mapper.map(surface.uv[self._pins]).uv
            self._influence = self.mapper.influence(self._number).view(np.float64).reshape(-1, 2)

    def placed(self, place: ArrayLike) -> NDArray[np.float64]:
        """UVs (t, 2) of the island's UV vertices, the dragged pin at a place (2,) of the UV map.

        On a circle the pin goes to the nearest point of it between its neighbours.
        """
        at = np.asarray(place, dtype=np.float64) / self._surface.scale
        if self._disk is not None:
            return self._on_circle(self._disk, np.asarray(place, dtype=np.float64))
        x, y = at - self._start
        real, imaginary = self._influence.T
        uv = self._uv + np.column_stack((real * x - imaginary * y, real * y + imaginary * x))
        uv[self._pins] = self._surface.uv[self._pins]
        uv[self._pins[self._number]] = at
        return uv * self._surface.scale

    def _on_circle(self, disk: DiskIsland, place: NDArray[np.float64]) -> NDArray[np.float64]:
        before = disk.z[self._pins]
        after = before.copy()
        pin = before[self._number]
        others = np.delete(before, self._number)
        ahead = np.sort(np.angle(others / pin) % (2.0 * np.pi))  # of the pin, around the circle
        wanted = disk.place.to_disk(place[None])[0] / pin
        turn = float(np.angle(wanted))
        turn = min(max(turn, ahead[1] - 2.0 * np.pi + APART), ahead[0] - APART)
        after[self._number] = pin * np.exp(1j * turn)
        return disk.placed(Moebius.from_three_pairs(before, after))


def _three_on_circle(disk: DiskIsland, pins: NDArray[np.int64]) -> bool:
    return len(pins) == ON_CIRCLE and bool(np.isin(pins, disk.rim).all())
