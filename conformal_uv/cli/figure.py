"""Figure 1 of the report for any mesh: the surface, the flattened mesh, the angle error on it."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..disk import DiskMap
from ..errors import MissingDependencyError, OptionError
from ..files import replaced_file

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["check_drawable", "draw_disk_map"]

SUFFIXES = (".png", ".pdf", ".svg")

DETAILED = 20000  # faces up to which edges are drawn
LIGHT = np.array([-0.35, 0.45, 0.82])


def check_drawable(path: Path) -> None:
    """Raise OptionError or MissingDependencyError where no picture could be drawn into this file."""
    if path.suffix.lower() not in SUFFIXES:
        raise OptionError(f"--plot {path.name}: choose a file name that ends in {', '.join(SUFFIXES)}.")
    if find_spec("matplotlib") is None:
        raise MissingDependencyError('--plot needs matplotlib: pip install "conformal-uv[plot]".')


def draw_disk_map(path: Path, result: DiskMap, title: str) -> None:
    """Draw a disk map into a PNG, PDF or SVG file."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(15, 5.4), dpi=130, layout="constrained")
    left, middle, right = figure.subplots(1, 3)
    V, F = result.surface.V, result.surface.F
    flat, depth, shade = _view(V, F)
    far_first = np.argsort(depth)
    _add_faces(left, flat[F[far_first]], shade[far_first])
    left.set_title(f"{title}: {len(V)} vertices, {len(F)} triangles")
    edges = {"edgecolors": "0.25", "linewidths": 0.3 if len(F) > 2000 else 0.6} if len(F) <= DETAILED else {}
    _add_faces(middle, result.uv[F], shade, **edges)
    middle.set_title(f"{result.method} map, conformal energy {result.conformal_energy:.3g}")
    _draw_error(figure, right, result)
    for axes in (left, middle, right):
        axes.set_aspect("equal")
        axes.set_axis_off()
        axes.autoscale_view()
    with replaced_file(path) as out:
        figure.savefig(out, format=path.suffix[1:].lower())


def _view(
    V: NDArray[np.float64], F: NDArray[np.int32]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """The surface seen along its mean normal: positions (n, 2), depth (m,) and colour (m, 4) of each face."""
    cross = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    mean = cross.sum(axis=0)
    if np.linalg.norm(mean) < 1e-3 * np.linalg.norm(cross, axis=1).sum():
        mean = np.array([1.0, -1.0, 0.8])
    front = mean / np.linalg.norm(mean)
    up = np.array([0.0, 1.0, 0.0]) if abs(front[1]) < 0.8 else np.array([0.0, 0.0, 1.0])
    right = np.cross(up, front)
    right /= np.linalg.norm(right)
    axes = np.stack((right, np.cross(front, right), front))
    turned = V @ axes.T
    length = np.maximum(np.linalg.norm(cross, axis=1, keepdims=True), np.finfo(float).tiny)
    facing = (cross / length) @ axes.T @ (LIGHT / np.linalg.norm(LIGHT))
    light = 0.97 * (0.5 + 0.5 * facing) ** 1.5
    colour = np.column_stack((light, 0.97 * light, 0.92 * light, np.ones(len(F))))
    return turned[:, :2], turned[F, 2].mean(axis=1), colour


def _draw_error(figure: Any, axes: Axes, result: DiskMap) -> None:
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    error = result.distortion.angle_error.mean(axis=1)
    norm = Normalize(0.0, max(float(np.percentile(error, 99)), 1e-6))
    colours = colormaps["viridis"](norm(error))
    colours[result.flipped] = [0.9, 0.1, 0.1, 1.0]
    _add_faces(axes, result.uv[result.surface.F], colours)
    bar = figure.colorbar(ScalarMappable(norm, "viridis"), ax=axes, shrink=0.75, extend="max")
    bar.set_label("angle error, degrees (mean of a face)")
    told = f"angle error: mean {result.distortion.angle_mean:.3g}, max {result.distortion.angle_max:.3g} degrees"
    axes.set_title(f"{told}; {len(result.flipped)} flipped (red)" if len(result.flipped) else told)


def _add_faces(axes: Axes, polygons: NDArray[np.float64], colours: NDArray[np.float64], **edges: Any) -> None:
    from matplotlib.collections import PolyCollection

    style = edges or {"edgecolors": "face", "linewidths": 0.2}
    axes.add_collection(PolyCollection(list(polygons), facecolors=colours, rasterized=True, **style))
