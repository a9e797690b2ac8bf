"""One slide under way: what the mouse, the wheel and typed numbers make of a map of the disk; no events, no bpy."""

from __future__ import annotations

import math

from conformal_uv import Moebius

from .disks import limited


class Slide:
    """A map of the unit disk onto itself, changed by drags, turns and numbers in any order.

    Attributes
    ----------
    center : complex
        Where the middle has gone.
    rotation : float
        By how much it is turned about itself, radians.
    """

    def __init__(self, center: complex = 0.0, rotation: float = 0.0) -> None:
        self.center, self.rotation = limited(complex(center)), rotation
        self._base, self._from, self._to = self.moebius, 0j, 0j

    @property
    def moebius(self) -> Moebius:
        """The map."""
        return Moebius.of_disk(self.center, self.rotation)

    @property
    def grip(self) -> complex:
        """Where what was gripped is now."""
        return limited(self._to)

    def grip_at(self, place: complex) -> None:
        """From now on drags move what lies at this place of the picture."""
        self._base = self.moebius
        self._from = self._to = place = limited(place)

    def drag(self, by: complex) -> None:
        """Move the grip, which may leave the disk and come back."""
        self._to += by
        moved = Moebius.disk_translation(self._from, self.grip) @ self._base
        center, rotation = moved.center_and_rotation()
        self.center = limited(center)
        turns = round((self.rotation - rotation) / (2.0 * math.pi))  # keep on counting beyond half a turn
        self.rotation = rotation + 2.0 * math.pi * turns

    def turn(self, by: float) -> None:
        """Turn about the middle, wherever that is."""
        self.rotation += by
        self._rebase()

    def put(self, name: str, value: float) -> None:
        """Set "rotation" (degrees), "x" or "y" (of the centre) to a number."""
        if name == "rotation":
            self.rotation = math.radians(value)
        else:
            x, y = (value, self.center.imag) if name == "x" else (self.center.real, value)
            self.center = limited(complex(x, y))
        self._rebase()

    def _rebase(self) -> None:
        """Go on from here: the grip stays where it is, on whatever lies there now."""
        self._base, self._from = self.moebius, self.grip
        self._to = self._from
