"""Edges and points drawn over the UV editor while a tool runs; in Object Mode it shows no UVs by itself."""

from __future__ import annotations

import bpy
import gpu
import numpy as np
from numpy.typing import NDArray

FAR = 4096.0  # Blender rounds positions in a region to pixels: the scale is read off a long way
EDGE, RIM = (0.85, 0.85, 0.85), (1.0, 0.55, 0.1, 1.0)
MANY, FEW_OPACITY, MANY_OPACITY = 20_000, 0.55, 0.2  # UV vertices, whose edges are not to hide the image
CENTER, PINNED, SELECTED = ((1.0, 1.0, 1.0, 1.0), 9.0), ((1.0, 0.25, 0.2, 1.0), 9.0), ((1.0, 1.0, 1.0, 1.0), 4.0)


class UVOverlay:
    """What is drawn, in UVs; remove it when the tool ends.

    Attributes
    ----------
    edges : list of ((t, 2) floats, GPU index buffer)
    points : list of ((k, 2) floats, (color, size))
    rims : list of (k, 2) floats
    """

    def __init__(self) -> None:
        self.edges: list[tuple[NDArray[np.floating], gpu.types.GPUIndexBuf]] = []
        self.points: list[tuple[NDArray[np.floating], tuple[tuple[float, ...], float]]] = []
        self.rims: list[NDArray[np.floating]] = []
        self._handle = bpy.types.SpaceImageEditor.draw_handler_add(self._draw, (), "WINDOW", "POST_PIXEL")

    def remove(self) -> None:
        """Draw nothing any more."""
        if self._handle is not None:
            bpy.types.SpaceImageEditor.draw_handler_remove(self._handle, "WINDOW")
            self._handle = None

    def _draw(self) -> None:
        shader = gpu.shader.from_builtin("UNIFORM_COLOR")
        depth = gpu.state.depth_test_get()
        gpu.state.blend_set("ALPHA")
        gpu.state.depth_test_set("NONE")  # since 5.0 the image would hide what is drawn
        with gpu.matrix.push_pop():
            self._to_region(bpy.context.region.view2d)
            for values, pairs in self.edges:
                opacity = FEW_OPACITY if len(values) < MANY else MANY_OPACITY
                _colored(shader, _batch("LINES", values, pairs), (*EDGE, opacity))
            for rim in self.rims:
                _colored(shader, _batch("LINE_STRIP", rim), RIM)
            for points, (color, size) in self.points:
                if len(points):
                    gpu.state.point_size_set(size)
                    _colored(shader, _batch("POINTS", points), color)
            gpu.state.point_size_set(1.0)
        gpu.state.depth_test_set(depth)
        gpu.state.blend_set("NONE")

    @staticmethod
    def _to_region(view: bpy.types.View2D) -> None:
        """From UVs to pixels of the region."""
        origin = np.array(view.view_to_region(0.0, 0.0, clip=False), dtype=float)
        scale = (np.array(view.view_to_region(FAR, FAR, clip=False), dtype=float) - origin) / FAR
        gpu.matrix.translate((*origin.tolist(), 0.0))
        gpu.matrix.scale((*scale.tolist(), 1.0))


def line_pairs(sides: NDArray[np.int64]) -> gpu.types.GPUIndexBuf:
    """Edges (e, 2), each once, as the GPU takes them."""
    key = np.unique(np.sort(sides, axis=1) @ np.array([1 << 32, 1]))
    pairs = np.column_stack((key >> 32, key & 0xFFFFFFFF)).astype(np.int32)
    return gpu.types.GPUIndexBuf(type="LINES", seq=pairs)


def _batch(kind: str, points: NDArray[np.floating], pairs: gpu.types.GPUIndexBuf | None = None) -> gpu.types.GPUBatch:
    """Points (k, 2) at height 0, as the built-in shaders take them."""
    places = np.zeros((len(points), 3), dtype=np.float32)
    places[:, :2] = points
    layout = gpu.types.GPUVertFormat()
    layout.attr_add(id="pos", comp_type="F32", len=3, fetch_mode="FLOAT")
    vertices = gpu.types.GPUVertBuf(layout, len(places))
    vertices.attr_fill("pos", places)
    return gpu.types.GPUBatch(type=kind, buf=vertices, **({} if pairs is None else {"elem": pairs}))


def _colored(shader: gpu.types.GPUShader, batch: gpu.types.GPUBatch, color: tuple[float, ...]) -> None:
    shader.bind()
    shader.uniform_float("color", color)
    batch.draw(shader)
