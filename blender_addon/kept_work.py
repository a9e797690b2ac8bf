"""Factorizations kept between calls, so that the redo panel asks the same ones again.

Undo gives meshes new addresses, therefore work is found again by the content of the mesh.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from conformal_uv import Callback, PolygonMesh, Unwrapped, Unwrapper
from conformal_uv.options import (
    Balance,
    Closed,
    CornerChoice,
    Holes,
    Method,
    NonManifold,
    Orientation,
    Repair,
    Shape,
    Upright,
)

from .mesh_reading import MeshArrays
from .pins import offered_pins
from .properties import Options

Key = tuple[bytes, bool, str]


@dataclass(eq=False)
class Surface:
    """What is solved for one object.

    Attributes
    ----------
    arrays : MeshArrays
    chosen : (p,) bool
        Faces to unwrap.
    active : int or None
        Vertex for the centre.
    pinned_uv : dict of int to (float, float)
        Corners that stay where they are.
    """

    arrays: MeshArrays
    chosen: np.ndarray
    active: int | None
    pinned_uv: dict[int, tuple[float, float]] = field(default_factory=dict)
    _digest: bytes = field(init=False, default=b"")

    def key(self, options: Options) -> Key:
        """What a factorization depends on."""
        self._digest = self._digest or self.arrays.digest(self.chosen)
        return self._digest, options.fill_holes, options.closed


class KeptWork:
    """The unwrappers of the last call, with the last result of each in every shape."""

    def __init__(self) -> None:
        self._unwrappers: dict[Key, Unwrapper] = {}
        self._results: dict[Key, dict[str, tuple[dict[str, Any], Unwrapped]]] = {}

    def unwrapped(
        self, surface: Surface, options: Options, *, callback: Callback | None = None, backend: str = "auto"
    ) -> Unwrapped:
        """The charts of the surface, each in the square [-1, 1]^2.

        `backend` counts when there is no factorization yet. Errors are those of `conformal_uv.unwrap`.
        """
        key, asked = surface.key(options), _call(surface, options)
        kept = self._results.get(key, {}).get(options.shape)
        if kept is not None and kept[0] == asked:
            return kept[1]
        unwrapper = self._unwrappers.get(key)
        if unwrapper is None:
            unwrapper = _unwrapper(surface, options, callback, backend)
            self._unwrappers[key] = unwrapper
        result = unwrapper.unwrap(**asked, place="disk", callback=callback)
        self._results[key] = {**self._results.get(key, {}), options.shape: (asked, result)}
        return result

    def fork(self) -> KeptWork:
        """The same work, what is added to it being the fork's own."""
        fork = KeptWork()
        fork.adopt(self)
        return fork

    def adopt(self, other: KeptWork) -> None:
        """Keep what `other` keeps, too."""
        self._unwrappers.update(other._unwrappers)
        self._results.update(other._results)

    def keep_only(self, keys: set[Key]) -> None:
        """Forget everything else."""
        for kept in (self._unwrappers, self._results):
            for key in set(kept) - keys:
                del kept[key]


KEPT = KeptWork()


def _unwrapper(surface: Surface, options: Options, callback: Callback | None, backend: str) -> Unwrapper:
    arrays = surface.arrays
    mesh = PolygonMesh(arrays.V.astype(np.float64), arrays.corners.astype(np.int64), arrays.starts.astype(np.int64))
    return Unwrapper(
        None,
        mesh,
        seams=arrays.seams,
        selection=surface.chosen,
        holes=Holes.FILL if options.fill_holes else Holes.REFUSE,
        closed=Closed[options.closed],
        nonmanifold=NonManifold.CUT,
        orientation=Orientation.MEND,
        backend=backend,
        callback=callback,
    )


def _call(surface: Surface, options: Options) -> dict[str, Any]:
    """Options that a factorization does not depend on and that mean something for the shape, as keywords of
    Unwrapper.unwrap."""
    shape = Shape[options.shape]
    pins = offered_pins(surface.arrays, surface.chosen, options)
    call: dict[str, Any] = {
        "shape": shape,
        "upright": Upright[options.upright],
        "pins": None if pins is None else set(pins),
        "rotation": options.rotation,
        "repair": Repair.AUTO if options.repair else Repair.NEVER,
    }
    if shape is Shape.DISK:
        call["method"] = Method[options.method]
        call["center"] = surface.active if options.takes_active else None
        call["balance"] = Balance.AREA if options.center == "AREA" else Balance.MIDDLE
    elif shape is Shape.FREE:
        call["refine"] = options.refine
        call["pinned_uv"] = surface.pinned_uv
    else:
        call["corner_choice"] = CornerChoice[options.corner_choice]
    return call
