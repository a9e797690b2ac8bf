"""UVs that a tool writes many times a second, and puts back to the bit when it is cancelled.

In Edit Mode a mesh's UVs can only be written loop by loop, or by leaving and entering the mode: a large mesh then
moves a few times a second. So the objects are in Object Mode as long as the tool runs, where its arrays are written
as they are, and go back to Edit Mode with it.
"""

from __future__ import annotations

from contextlib import ExitStack

import bpy
import numpy as np
from numpy.typing import NDArray

from .edit_mode import object_mode
from .mesh_reading import read_uv


class LiveUVs:
    """The active UV maps of some objects while a tool runs.

    Parameters
    ----------
    context : bpy.types.Context
    objects : list of objects
        Each with an active UV map.

    Attributes
    ----------
    values : dict of object to (k, 2) float32
        What `show` writes; to be changed in place.
    """

    def __init__(self, context: bpy.types.Context, objects: list[bpy.types.Object]) -> None:
        self._stack = ExitStack()
        self._stack.enter_context(object_mode(context))
        self._before = {ob: read_uv(ob.data, ob.data.uv_layers.active.name) for ob in objects}
        self.values = {ob: before.copy() for ob, before in self._before.items()}

    def show(self, ob: bpy.types.Object) -> None:
        """Write an object's values."""
        self._write(ob, self.values[ob])

    def keep(self) -> None:
        """End: what was shown stays, and the mode is the one before."""
        self._stack.close()

    def restore(self) -> None:
        """End: every UV is what it was, and the mode is the one before."""
        for ob, before in self._before.items():
            self._write(ob, before)
        self._stack.close()

    def _write(self, ob: bpy.types.Object, values: NDArray[np.float32]) -> None:
        mesh = ob.data
        mesh.attributes[mesh.uv_layers.active.name].data.foreach_set("vector", values.reshape(-1))
        mesh.update()
