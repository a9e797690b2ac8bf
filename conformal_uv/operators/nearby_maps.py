"""Folds and angles of maps of one surface most of whose vertices lie alike, worked out where they differ."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..mesh.stars import faces_at
from ..mesh.surface import Surface
from .angle_mean import AngleMean
from .orientation_sign import collapsed_faces, flipped_faces

__all__ = ["NearbyMaps"]

Complex = NDArray[np.complex128]
Faces = NDArray[np.int64]


class NearbyMaps:
    """What is asked of positions in the plane, told by what it is at others.

    Parameters
    ----------
    surface : Surface
    z : (n,) complex128
        The positions that others are compared with.
    flipped : (k,) int64
        The faces flipped there.
    """

    def __init__(self, surface: Surface, z: Complex, flipped: Faces) -> None:
        self._surface, self._z, self._flipped = surface, z, flipped
        self._last = z, np.zeros(surface.n, dtype=bool), np.empty(0, dtype=np.int64)

    def angle_mean(self, z: Complex) -> float:
        """Mean angle error over all corners, degrees."""
        if z is self._z:
            return self._angles.first
        return self._angles.of(z, self._changed(z)[1])

    def flipped(self, z: Complex) -> Faces:
        """As `flipped_faces`."""
        return self._updated(flipped_faces, self._flipped, z)

    def collapsed(self, z: Complex) -> Faces:
        """As `collapsed_faces`."""
        return self._updated(collapsed_faces, self._collapsed, z)

    @cached_property
    def _angles(self) -> AngleMean:
        return AngleMean(self._surface, self._z)

    @cached_property
    def _collapsed(self) -> Faces:
        return collapsed_faces(self._z, self._surface.corners)

    def _updated(self, pick: Callable[[Complex, NDArray[np.int32]], Faces], found: Faces, z: Complex) -> Faces:
        """The faces that are picked at z; `found` are those at the first positions."""
        if z is self._z:
            return found
        moved, changed = self._changed(z)
        a, b, c = (moved.take(corner) for corner in self._surface.corners.take(found, axis=1))
        stays = found[~(a | b | c)]
        here = changed[pick(z, self._surface.corners.take(changed, axis=1))]
        return np.sort(np.concatenate((stays, here)))

    def _changed(self, z: Complex) -> tuple[NDArray[np.bool_], Faces]:
        """Vertices that lie elsewhere than at first, and the faces at them; those asked for last are kept."""
        if z is not self._last[0]:
            moved = z != self._z
            self._last = z, moved, faces_at(self._surface.corners, moved)
        return self._last[1:]
