"""Vertices that a map is to bring to given places: three of a disk's boundary, or the four corners of a rectangle."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from conformal_uv import Chart, DiskMap, RectangleMap

from .mesh_reading import MeshArrays
from .properties import Options

CORNERS = 4
NO_CORNERS = (
    "no pin and no selected vertex gives corners, they are automatic; pin four UVs on the boundary, or select four "
    "vertices there and no face"
)
HOW_TO_USE = {
    "DISK": "pinned UVs stay where they are; unpin them, or pin three on the boundary and turn on Use Pins",
    "FREE": "pinned UVs stay where they are; unpin them, or pin two or more and turn on Use Pins",
    "RECTANGLE": "pinned UVs stay where they are; unpin them, or pin four on the boundary and turn on Use Pins",
}


def offered_pins(arrays: MeshArrays, chosen: NDArray[np.bool_], options: Options) -> list[int] | None:
    """Vertices that islands may take, each once, in the order of the corners; None where none are asked for.

    They are the pinned ones of the chosen faces (p,); for rectangles, where there are none, those selected by
    themselves.
    """
    if not options.takes_pins:
        return None
    pins = _used(arrays, chosen, arrays.pins)
    return pins if pins or not options.takes_selected_corners else _used(arrays, chosen, arrays.alone)


def held_uvs(
    arrays: MeshArrays, chosen: NDArray[np.bool_], scale: NDArray[np.float64]
) -> dict[int, tuple[float, float]]:
    """Pinned corners of the chosen faces (p,) and where they are, in a plane that `scale` (2,) makes the texture of."""
    kept = np.repeat(chosen, np.diff(arrays.starts))[arrays.pin_corners]
    places = arrays.pin_places[kept].astype(np.float64) / scale
    return dict(zip(arrays.pin_corners[kept].tolist(), map(tuple, places.tolist()), strict=True))


def took_pins(chart: Chart, offered: list[int] | None) -> bool:
    """Whether a mapped chart could use them."""
    if offered is None:
        return False
    if isinstance(chart.map, RectangleMap):
        boundary = chart.vertices[chart.map.boundary]
        return len(np.unique(boundary[np.isin(boundary, offered)])) == CORNERS
    return isinstance(chart.map, DiskMap) and chart.map.pins is not None


def _used(arrays: MeshArrays, chosen: NDArray[np.bool_], vertices: NDArray[np.int32]) -> list[int]:
    used = np.zeros(len(arrays.V), dtype=bool)
    used[arrays.corners[np.repeat(chosen, np.diff(arrays.starts))]] = True
    vertices = vertices[used[vertices]]
    _, first = np.unique(vertices, return_index=True)
    return vertices[np.sort(first)].tolist()
