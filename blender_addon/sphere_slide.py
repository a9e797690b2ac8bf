"""Spheres of objects (shape key and UVs), turned and magnified; read, written live, and put back to the bit."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import bpy
import numpy as np
from numpy.typing import NDArray

from conformal_uv import SphereMoebius, StoredSphere, on_sphere, stored_sphere

from .live_uvs import LiveUVs
from .spheres import SHAPE_KEY
from .uv_objects import UVObject, uv_objects

NONE_FOUND = "no shape key has the positions of a sphere; use Object > Conformal Sphere Map first"
NO_LAYOUT = "the active UV map is no layout of the sphere; use Object > Conformal Sphere Map with UVs first"
MOST = 0.999  # length of the direction of a boost; beyond, single precision loses the rest


@dataclass(frozen=True, eq=False)
class Sphere:
    """An object with its map to the sphere."""

    read: UVObject
    stored: StoredSphere

    @property
    def ob(self) -> bpy.types.Object:
        """The object."""
        return self.read.ob

    @property
    def key(self) -> bpy.types.ShapeKey:
        """Its shape key."""
        return self.ob.data.shape_keys.key_blocks[SHAPE_KEY]


def find_spheres(context: bpy.types.Context, objects: Iterable[bpy.types.Object]) -> list[Sphere]:
    """Those of the objects whose shape key is a sphere."""
    found = []
    for read in uv_objects(context, objects):
        keys = read.ob.data.shape_keys
        if keys is None or SHAPE_KEY not in keys.key_blocks:
            continue
        stored = stored_sphere(read.mesh, _positions(keys.key_blocks[SHAPE_KEY]), read.uv)
        if stored is not None:
            found.append(Sphere(read, stored))
    return found


def laid_out(spheres: list[Sphere]) -> list[Sphere]:
    """Those whose active UV map is a layout of the sphere."""
    return [sphere for sphere in spheres if sphere.stored.octahedron is not None]


class LiveSpheres:
    """Shape keys and UVs of spheres while a tool runs; all objects are in Object Mode."""

    def __init__(self, context: bpy.types.Context, spheres: list[Sphere]) -> None:
        self._spheres = spheres
        self._live = LiveUVs(context, [sphere.ob for sphere in spheres])
        self._before = {sphere: _positions(sphere.key) for sphere in spheres}
        self._moved: dict[Sphere, NDArray[np.float64]] = {}

    def show(self, moebius: SphereMoebius) -> None:
        """Write what a map of the sphere makes of them; shape keys that are not seen now only at the end."""
        for sphere in self._spheres:
            moved = moebius(sphere.stored.xyz)
            self._moved[sphere] = moved
            if sphere.key.value != 0.0 or sphere.ob.show_only_shape_key:
                self._write_key(sphere)
            if sphere.stored.octahedron is not None:
                self._live.values[sphere.ob][:] = sphere.stored.uv(moved)
            self._live.show(sphere.ob)

    def keep(self) -> None:
        """End: what was shown stays."""
        for sphere in self._moved:
            self._write_key(sphere)
        self._live.keep()

    def restore(self) -> None:
        """End: everything is what it was."""
        for sphere, before in self._before.items():
            sphere.key.data.foreach_set("co", before.reshape(-1))
        self._live.restore()

    def _write_key(self, sphere: Sphere) -> None:
        positions = sphere.stored.positions(self._moved[sphere]).astype(np.float32)
        sphere.key.data.foreach_set("co", positions.reshape(-1))


class SphereSlide:
    """A map of the sphere, changed by drags and by the wheel.

    Attributes
    ----------
    moebius : SphereMoebius
    """

    def __init__(self, octahedron: bool) -> None:
        self.moebius = SphereMoebius.of()
        self._octahedron = octahedron
        self._grip: NDArray[np.float64] | None = None

    def grip_at(self, uv: tuple[float, float]) -> None:
        """From now on drags move what lies there."""
        self._grip = self._direction(uv)

    def drag(self, uv: tuple[float, float], part: float = 1.0) -> None:
        """Turn the sphere so that the grip comes to a place, or a part of the way to it."""
        there = self._direction(uv)
        if part != 1.0:
            there = self._grip + part * (there - self._grip)
            there /= np.linalg.norm(there)
        self.moebius = SphereMoebius.rotation_to(self._grip, there) @ self.moebius
        self.grip_at(uv)

    def magnify(self, uv: tuple[float, float], rapidity: float) -> None:
        """Make what lies at a place larger by the exponential of a number, everything else moving away from it."""
        boost = SphereMoebius.of(-math.tanh(rapidity) * self._direction(uv))
        self.moebius = _limited(boost @ self.moebius)

    @property
    def degrees(self) -> float:
        """By how much the sphere is turned about its upright axis, as the last of three Euler angles."""
        _, rotation = self.moebius.toward_and_rotation()
        return math.degrees(math.atan2(rotation[1, 0], rotation[0, 0]))

    def put(self, name: str, value: float) -> None:
        """Set "rotation" (degrees about the upright axis), or "x", "y" or "z" of where points move to, to a number."""
        toward, rotation = self.moebius.toward_and_rotation()
        if name == "rotation":
            angle = math.radians(value - self.degrees)
            cosine, sine = math.cos(angle), math.sin(angle)
            rotation = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]]) @ rotation
        else:
            toward = toward.copy()
            toward["xyz".index(name)] = value
        self.moebius = SphereMoebius.of(_short(toward), rotation)

    def _direction(self, uv: tuple[float, float]) -> NDArray[np.float64]:
        return on_sphere(np.array([uv]), octahedron=self._octahedron)[0]


def _limited(moebius: SphereMoebius) -> SphereMoebius:
    toward, rotation = moebius.toward_and_rotation()
    return moebius if np.linalg.norm(toward) <= MOST else SphereMoebius.of(_short(toward), rotation)


def _short(toward: NDArray[np.float64]) -> NDArray[np.float64]:
    return toward * (MOST / max(float(np.linalg.norm(toward)), MOST))


def _positions(key: bpy.types.ShapeKey) -> NDArray[np.float32]:
    out = np.empty(3 * len(key.data), dtype=np.float32)
    key.data.foreach_get("co", out)
    return out.reshape(-1, 3)
