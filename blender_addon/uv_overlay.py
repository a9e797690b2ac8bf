"""Edges and points drawn over the UV editor while a tool runs; in Object Mode it shows no UVs by itself."""

from __future__ import annotations

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader
from numpy.typing import NDArray

FAR = 4096.0  # Blender rounds positions in a region to pixels: the scale is read off a long way
EDGE, RIM = (0.85, 0.85, 0.85, 0.55), (1.0, 0.55, 0.1, 1.0)
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
        gpu.state.blend_set("ALPHA")
        with gpu.matrix.push_pop():
            self._to_region(bpy.context.region.view2d)
            for values, pairs in self.edges:
                vertices = gpu.types.GPUVertBuf(shader.format_calc(), len(values))
                vertices.attr_fill("pos", _in_space(values))
                _colored(shader, gpu.types.GPUBatch(type="LINES", buf=vertices, elem=pairs), EDGE)
            for rim in self.rims:
                _colored(shader, batch_for_shader(shader, "LINE_STRIP", {"pos": _in_space(rim)}), RIM)
            for points, (color, size) in self.points:
                if len(points):
                    gpu.state.point_size_set(size)
                    _colored(shader, batch_for_shader(shader, "POINTS", {"pos": _in_space(points)}), color)
            gpu.state.point_size_set(1.0)
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


def _in_space(points: NDArray[np.floating]) -> NDArray[np.float32]:
    """Points (k, 2) at height 0, as the built-in shaders take them."""
    out = np.zeros((len(points), 3), dtype=np.float32)
    out[:, :2] = points
    return out


def _colored(shader: gpu.types.GPUShader, batch: gpu.types.GPUBatch, color: tuple[float, ...]) -> None:
    shader.bind()
    shader.uniform_float("color", color)
    batch.draw(shader)
