"""Figure 1 of the report for any mesh: the surface, the flattened mesh, the angle error on it."""

from __future__ import annotations

import io
from collections.abc import Iterable
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..charts import Chart, Unwrapped
from ..console.summary import shape_name
from ..errors import MissingDependencyError, OptionError
from ..files import replaced_file
from ..free import FreeMap
from ..operators import Distortion, distortion
from ..options import Upright
from ..rectangle import RectangleMap
from ..sphere import SphereMap
from .texture import Texture

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["check_drawable", "draw_sphere_map", "draw_unwrapped", "sphere_picture", "texture_picture"]

SUFFIXES = (".png", ".pdf", ".svg")

DETAILED = 20000  # faces up to which each is a shape of its own, with edges in the map
LIES_FLAT = 0.05  # sine of the slope, as of charts
FLIPPED = (0.9, 0.1, 0.1, 1.0)
LIGHT = np.array([-0.35, 0.45, 0.82])


def check_drawable(path: Path) -> None:
    """Raise OptionError or MissingDependencyError where no picture could be drawn into this file."""
    if path.suffix.lower() not in SUFFIXES:
        raise OptionError(f"--plot {path.name}: choose a file name that ends in {', '.join(SUFFIXES)}.")
    if find_spec("matplotlib") is None:
        raise MissingDependencyError('--plot needs matplotlib: pip install "conformal-uv[plot]".')


def draw_unwrapped(path: Path, result: Unwrapped, title: str, upright: Upright = Upright.NONE) -> None:
    """Draw an unwrapped mesh into a PNG, PDF or SVG file, the surface `upright` as its charts are."""
    charts = [chart for chart in result.charts if chart.map is not None]
    corners = np.concatenate([chart.mesh.V[chart.F] for chart in charts])
    image = np.concatenate([result.uv[chart.corner] for chart in charts])
    figure = _unwrapped_figure(corners, image, _joined(charts), title, _caption(charts), upright)
    with replaced_file(path) as out:
        figure.savefig(out, format=path.suffix[1:].lower())


def draw_sphere_map(path: Path, result: SphereMap, title: str) -> None:
    """Draw a closed surface and its sphere from two sides in the same colours, and the angle error on the sphere."""
    surface = result.surface
    caption = f"{result.method} map, conformal energy {result.conformal_energy:.3g}"
    figure = _sphere_figure(surface.V, surface.F, result.xyz, result.distortion, title, caption)
    with replaced_file(path) as out:
        figure.savefig(out, format=path.suffix[1:].lower())


def texture_picture(texture: Texture, title: str, caption: str, upright: Upright, dpi: float) -> bytes:
    """A PNG of a file's mesh with its texture coordinates, as `draw_unwrapped` draws it."""
    return _png(_unwrapped_figure(texture.corners, texture.image, texture.distortion, title, caption, upright), dpi)


def sphere_picture(
    V: NDArray[np.float64], F: NDArray[np.int64], xyz: NDArray[np.float64], title: str, caption: str, dpi: float
) -> bytes:
    """A PNG of a closed surface and its image on the sphere, as `draw_sphere_map` draws it."""
    return _png(_sphere_figure(V, F, xyz, distortion(V, F, xyz), title, caption), dpi)


def _png(figure: Figure, dpi: float) -> bytes:
    out = io.BytesIO()
    figure.savefig(out, format="png", dpi=dpi)
    return out.getvalue()


def _unwrapped_figure(
    corners: NDArray[np.float64],
    image: NDArray[np.float64],
    measured: Distortion,
    title: str,
    caption: str,
    upright: Upright,
) -> Figure:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(15, 5.4), dpi=130, layout="constrained")
    left, middle, right = figure.subplots(1, 3)
    count = len(corners)
    flat, depth, shade = _view(corners, upright)
    far_first = np.argsort(depth)
    _add_faces(left, flat[far_first], shade[far_first])
    left.set_title(f"{title}: {count} triangles")
    edges = {"edgecolors": "0.25", "linewidths": 0.3 if count > 2000 else 0.6} if count <= DETAILED else {}
    _add_faces(middle, image, shade, **edges)
    middle.set_title(caption)
    _draw_faces_by_error(figure, right, measured, image, np.arange(float(count)))
    _fit((left, middle, right))
    return figure


def _sphere_figure(
    V: NDArray[np.float64],
    F: NDArray[np.integer],
    xyz: NDArray[np.float64],
    measured: Distortion,
    title: str,
    caption: str,
) -> Figure:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(15, 5.4), dpi=130, layout="constrained")
    axes = figure.subplots(1, 3)
    middle = xyz[F].mean(axis=1)
    hue = 0.5 + 0.45 * middle / np.linalg.norm(middle, axis=1, keepdims=True)
    hue = np.column_stack((hue, np.ones(len(F))))
    for place, positions in ((axes[0], V), (axes[1], xyz)):
        flat, depth, shade = _view(positions[F])
        far_first = np.argsort(depth)
        _add_faces(place, flat[far_first], (hue * np.sqrt(shade))[far_first])
    axes[0].set_title(f"{title}: {len(xyz)} vertices")
    axes[1].set_title(caption)
    flat, depth, _ = _view(xyz[F])
    _draw_faces_by_error(figure, axes[2], measured, flat, depth)
    _fit(axes)
    return figure


def _fit(places: Iterable[Axes]) -> None:
    for axes in places:
        axes.set_aspect("equal")
        axes.set_axis_off()
        axes.autoscale_view()


def _draw_faces_by_error(
    figure: Any, axes: Axes, measured: Distortion, image: NDArray[np.float64], depth: NDArray[np.float64]
) -> None:
    """The faces, those of less depth first; of the flipped ones all that are not behind 0 lie on top."""
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    error = measured.angle_error.mean(axis=1)
    norm = Normalize(0.0, max(float(np.percentile(error, 99)), 1e-6))
    colours = colormaps["viridis"](norm(error))
    colours[measured.flipped] = FLIPPED
    far_first = np.argsort(depth)
    _add_faces(axes, image[far_first], colours[far_first])
    flipped = measured.flipped[depth[measured.flipped] >= 0]
    if len(image) > DETAILED >= len(flipped) > 0:  # with an outline, for they may be far smaller than a pixel
        _add_faces(axes, image[flipped], colours[flipped], edgecolors="face", linewidths=0.6)
    bar = figure.colorbar(ScalarMappable(norm, "viridis"), ax=axes, shrink=0.75, extend="max")
    bar.set_label("angle error, degrees (mean of a face)")
    told = f"angle error: mean {measured.angle_mean:.3g}, max {measured.angle_max:.3g} degrees"
    axes.set_title(f"{told}; {len(measured.flipped)} flipped (red)" if len(measured.flipped) else told)


def _caption(charts: list[Chart]) -> str:
    first = charts[0].map
    if len(charts) == 1 and first is not None:
        told = f"{shape_name(first)} map, conformal energy {first.conformal_energy:.3g}"
        if isinstance(first, RectangleMap):
            return f"{told}, modulus {first.modulus:.4g}"
        crosses = isinstance(first, FreeMap) and len(first.crossings)
        return f"{told}, boundary crosses itself" if crosses else told
    return f"{len(charts)} charts"


def _view(
    corners: NDArray[np.float64], upright: Upright = Upright.NONE
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Triangles (m, 3, 3) seen along their mean normal: in the picture (m, 3, 2), depth (m,), colour (m, 4)."""
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    mean = cross.sum(axis=0)
    if np.linalg.norm(mean) < 1e-3 * np.linalg.norm(cross, axis=1).sum():
        mean = np.array([1.0, -1.0, 0.8])
    front = mean / np.linalg.norm(mean)
    up = _up(front, upright)
    right = np.cross(up, front)
    right /= np.linalg.norm(right)
    axes = np.stack((right, np.cross(front, right), front))
    turned = corners @ axes.T
    length = np.maximum(np.linalg.norm(cross, axis=1, keepdims=True), np.finfo(float).tiny)
    facing = (cross / length) @ axes.T @ (LIGHT / np.linalg.norm(LIGHT))
    light = 0.97 * (0.5 + 0.5 * facing) ** 1.5
    colour = np.column_stack((light, 0.97 * light, 0.92 * light, np.ones(len(corners))))
    return turned[:, :, :2], turned[:, :, 2].mean(axis=1), colour


def _up(front: NDArray[np.float64], upright: Upright) -> NDArray[np.float64]:
    """What is up in the picture of a surface seen from `front`: as of its charts, else y, or z of what faces y."""
    y, z = np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0])
    if upright is Upright.NONE:
        return y if abs(front[1]) < 0.8 else z
    axis, beyond = (z, y) if upright is Upright.Z else (y, -z)
    return axis if np.linalg.norm(np.cross(front, axis)) > LIES_FLAT else beyond


def _joined(charts: list[Chart]) -> Distortion:
    """Distortion of all charts' triangles together."""
    parts = [chart.distortion for chart in charts if chart.distortion is not None]
    first = np.cumsum([0] + [len(part.area_scale) for part in parts[:-1]])
    return Distortion(
        np.concatenate([part.angle_error for part in parts]),
        np.concatenate([part.quasi_conformal for part in parts]),
        np.concatenate([part.area_scale for part in parts]),
        np.concatenate([part.flipped + start for part, start in zip(parts, first, strict=True)]),
    )


def _add_faces(axes: Axes, polygons: NDArray[np.float64], colours: NDArray[np.float64], **edges: Any) -> None:
    from matplotlib.collections import PolyCollection

    from .triangle_picture import TrianglePicture

    if len(polygons) > DETAILED:
        axes.add_artist(TrianglePicture(polygons, colours))
        x, y = polygons[:, :, 0], polygons[:, :, 1]
        axes.update_datalim([(x.min(), y.min()), (x.max(), y.max())])
        return
    style = edges or {"edgecolors": "face", "linewidths": 0.2}
    axes.add_collection(PolyCollection(list(polygons), facecolors=colours, rasterized=True, **style))
