"""Figure 1 of the report for any mesh: the surface, the flattened mesh, the angle error on it."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..charts import Chart, Unwrapped
from ..errors import MissingDependencyError, OptionError
from ..files import replaced_file

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["check_drawable", "draw_unwrapped"]

SUFFIXES = (".png", ".pdf", ".svg")

DETAILED = 20000  # faces up to which edges are drawn
LIGHT = np.array([-0.35, 0.45, 0.82])


def check_drawable(path: Path) -> None:
    """Raise OptionError or MissingDependencyError where no picture could be drawn into this file."""
    if path.suffix.lower() not in SUFFIXES:
        raise OptionError(f"--plot {path.name}: choose a file name that ends in {', '.join(SUFFIXES)}.")
    if find_spec("matplotlib") is None:
        raise MissingDependencyError('--plot needs matplotlib: pip install "conformal-uv[plot]".')


def draw_unwrapped(path: Path, result: Unwrapped, title: str) -> None:
    """Draw an unwrapped mesh into a PNG, PDF or SVG file."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(15, 5.4), dpi=130, layout="constrained")
    left, middle, right = figure.subplots(1, 3)
    charts = [chart for chart in result.charts if chart.map is not None]
    corners = np.concatenate([chart.mesh.V[chart.F] for chart in charts])
    image = np.concatenate([_in_texture(chart) for chart in charts])
    count = len(corners)
    flat, depth, shade = _view(corners)
    far_first = np.argsort(depth)
    _add_faces(left, flat[far_first], shade[far_first])
    left.set_title(f"{title}: {count} triangles")
    edges = {"edgecolors": "0.25", "linewidths": 0.3 if count > 2000 else 0.6} if count <= DETAILED else {}
    _add_faces(middle, image, shade, **edges)
    middle.set_title(_caption(charts))
    _draw_error(figure, right, charts, image)
    for axes in (left, middle, right):
        axes.set_aspect("equal")
        axes.set_axis_off()
        axes.autoscale_view()
    with replaced_file(path) as out:
        figure.savefig(out, format=path.suffix[1:].lower())


def _in_texture(chart: Chart) -> NDArray[np.float64]:
    """Corners of a chart's triangles in the texture, (m, 3, 2)."""
    uv = chart.map.uv[: len(chart.vertices)] if chart.map is not None else np.empty((0, 2))
    return np.asarray(chart.placement.center) + chart.placement.scale * uv[chart.F]


def _caption(charts: list[Chart]) -> str:
    first = charts[0].map
    if len(charts) == 1 and first is not None:
        return f"{first.method} map, conformal energy {first.conformal_energy:.3g}"
    return f"{len(charts)} charts"


def _view(
    corners: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Triangles (m, 3, 3) seen along their mean normal: in the picture (m, 3, 2), depth (m,), colour (m, 4)."""
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    mean = cross.sum(axis=0)
    if np.linalg.norm(mean) < 1e-3 * np.linalg.norm(cross, axis=1).sum():
        mean = np.array([1.0, -1.0, 0.8])
    front = mean / np.linalg.norm(mean)
    up = np.array([0.0, 1.0, 0.0]) if abs(front[1]) < 0.8 else np.array([0.0, 0.0, 1.0])
    right = np.cross(up, front)
    right /= np.linalg.norm(right)
    axes = np.stack((right, np.cross(front, right), front))
    turned = corners @ axes.T
    length = np.maximum(np.linalg.norm(cross, axis=1, keepdims=True), np.finfo(float).tiny)
    facing = (cross / length) @ axes.T @ (LIGHT / np.linalg.norm(LIGHT))
    light = 0.97 * (0.5 + 0.5 * facing) ** 1.5
    colour = np.column_stack((light, 0.97 * light, 0.92 * light, np.ones(len(corners))))
    return turned[:, :, :2], turned[:, :, 2].mean(axis=1), colour


def _draw_error(figure: Any, axes: Axes, charts: list[Chart], image: NDArray[np.float64]) -> None:
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    measured = [chart.distortion for chart in charts if chart.distortion is not None]
    error = np.concatenate([d.angle_error.mean(axis=1) for d in measured])
    largest = max(d.angle_max for d in measured)
    flipped = np.concatenate([np.isin(np.arange(len(d.area_scale)), d.flipped) for d in measured])
    norm = Normalize(0.0, max(float(np.percentile(error, 99)), 1e-6))
    colours = colormaps["viridis"](norm(error))
    colours[flipped] = [0.9, 0.1, 0.1, 1.0]
    _add_faces(axes, image, colours)
    bar = figure.colorbar(ScalarMappable(norm, "viridis"), ax=axes, shrink=0.75, extend="max")
    bar.set_label("angle error, degrees (mean of a face)")
    told = f"angle error: mean {error.mean():.3g}, max {largest:.3g} degrees"
    axes.set_title(f"{told}; {flipped.sum()} flipped (red)" if flipped.any() else told)


def _add_faces(axes: Axes, polygons: NDArray[np.float64], colours: NDArray[np.float64], **edges: Any) -> None:
    from matplotlib.collections import PolyCollection

    style = edges or {"edgecolors": "face", "linewidths": 0.2}
    axes.add_collection(PolyCollection(list(polygons), facecolors=colours, rasterized=True, **style))
