"""Figure 1 of the report for any mesh: the surface, the flattened mesh, the angle error on it."""

from __future__ import annotations

import io
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..charts import Chart, Unwrapped
from ..disk import DiskMap
from ..errors import MissingDependencyError, OptionError
from ..files import replaced_file
from ..free import FreeMap
from ..mapped_mesh import AnyMap, mapped_mesh
from ..operators import Distortion, distortion
from ..options import Upright
from ..rectangle import RectangleMap
from ..report import shape_name
from ..sphere import SphereMap
from .first_view import seen_triangles

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["check_drawable", "draw_figure", "draw_map", "map_figure", "sphere_picture", "texture_picture"]

SUFFIXES = (".png", ".pdf", ".svg")

DETAILED = 20000  # faces up to which each is a shape of its own, with edges in the map
FLIPPED = (0.9, 0.1, 0.1, 1.0)


def check_drawable(path: Path, name: str = "--plot") -> None:
    """Raise OptionError or MissingDependencyError where no picture could be drawn into this file."""
    if path.suffix.lower() not in SUFFIXES:
        raise OptionError(f"{name} {path.name}: choose a file name that ends in {', '.join(SUFFIXES)}.")
    if find_spec("matplotlib") is None:
        raise MissingDependencyError(f'{name} needs matplotlib: pip install "conformal-uv[plot]".')


def draw_map(path: Path, result: AnyMap, title: str, upright: Upright = Upright.NONE) -> None:
    """Draw `map_figure` into a PNG, PDF or SVG file."""
    draw_figure(path, map_figure(result, title, upright))


def draw_figure(path: Path, figure: Figure) -> None:
    """Write a figure into a file of the kind that its suffix says."""
    with replaced_file(path) as out:
        figure.savefig(out, format=path.suffix[1:].lower())


def map_figure(result: AnyMap, title: str = "", upright: Upright = Upright.NONE) -> Figure:
    """The surface, `upright` as charts are, its map, and the angle error on the map; spheres in matching colours."""
    figure = _empty()
    if isinstance(result, SphereMap):
        mapped = mapped_mesh(result)
        caption = f"{result.method} map, conformal energy {result.conformal_energy:.3g}"
        _draw_sphere(figure, mapped.V, mapped.F, mapped.image, mapped.distortion, (title, caption))
    elif isinstance(result, Unwrapped):
        charts = [chart for chart in result.charts if chart.map is not None]
        corners = np.concatenate([chart.mesh.V[chart.F] for chart in charts])
        image = np.concatenate([result.uv[chart.corner] for chart in charts])
        _draw_plane(figure, corners, image, _joined(charts), upright, (title, _caption(charts)))
    else:
        mapped = mapped_mesh(result)
        titles = title, _map_caption(result)
        _draw_plane(figure, mapped.V[mapped.F], mapped.image[mapped.F], mapped.distortion, upright, titles)
    return _fitted(figure)


def texture_picture(
    corners: NDArray[np.float64],
    image: NDArray[np.float64],
    measured: Distortion,
    titles: tuple[str, str],
    upright: Upright,
    dpi: float,
) -> bytes:
    """A PNG of triangles (m, 3, 3) and their texture coordinates (m, 3, 2), as `map_figure` shows them."""
    figure = _empty()
    _draw_plane(figure, corners, image, measured, upright, titles)
    return _png(_fitted(figure), dpi)


def sphere_picture(
    V: NDArray[np.float64], F: NDArray[np.int64], xyz: NDArray[np.float64], titles: tuple[str, str], dpi: float
) -> bytes:
    """A PNG of a closed surface and its image on the sphere, as `map_figure` shows them."""
    figure = _empty()
    _draw_sphere(figure, V, F, xyz, distortion(V, F, xyz), titles)
    return _png(_fitted(figure), dpi)


def _empty() -> Figure:
    from matplotlib.figure import Figure

    return Figure(figsize=(15, 5.4), dpi=130, layout="constrained")


def _fitted(figure: Figure) -> Figure:
    for axes in figure.axes[:3]:
        axes.set_aspect("equal")
        axes.set_axis_off()
        axes.autoscale_view()
    return figure


def _png(figure: Figure, dpi: float) -> bytes:
    out = io.BytesIO()
    figure.savefig(out, format="png", dpi=dpi)
    return out.getvalue()


def _draw_plane(
    figure: Figure,
    corners: NDArray[np.float64],
    image: NDArray[np.float64],
    measured: Distortion,
    upright: Upright,
    titles: tuple[str, str],
) -> None:
    """Triangles on the surface (m, 3, 3) and in the plane (m, 3, 2)."""
    left, middle, right = figure.subplots(1, 3)
    count = len(corners)
    flat, depth, shade = seen_triangles(corners, upright)
    far_first = np.argsort(depth)
    _add_faces(left, flat[far_first], shade[far_first])
    left.set_title(": ".join(filter(None, (titles[0], f"{count} triangles"))))
    edges = {"edgecolors": "0.25", "linewidths": 0.3 if count > 2000 else 0.6} if count <= DETAILED else {}
    _add_faces(middle, image, shade, **edges)
    middle.set_title(titles[1])
    _draw_faces_by_error(figure, right, measured, image, np.arange(float(count)))


def _draw_sphere(
    figure: Figure,
    V: NDArray[np.float64],
    F: NDArray[np.integer],
    xyz: NDArray[np.float64],
    measured: Distortion,
    titles: tuple[str, str],
) -> None:
    """A closed surface and its sphere in the same colours, and the angle error on the sphere."""
    axes = figure.subplots(1, 3)
    middle = xyz[F].mean(axis=1)
    hue = 0.5 + 0.45 * middle / np.linalg.norm(middle, axis=1, keepdims=True)
    hue = np.column_stack((hue, np.ones(len(F))))
    for place, positions in ((axes[0], V), (axes[1], xyz)):
        flat, depth, shade = seen_triangles(positions[F])
        far_first = np.argsort(depth)
        _add_faces(place, flat[far_first], (hue * np.sqrt(shade))[far_first])
    axes[0].set_title(": ".join(filter(None, (titles[0], f"{len(xyz)} vertices"))))
    axes[1].set_title(titles[1])
    flat, depth, _ = seen_triangles(xyz[F])
    _draw_faces_by_error(figure, axes[2], measured, flat, depth)


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
    return _map_caption(first) if len(charts) == 1 and first is not None else f"{len(charts)} charts"


def _map_caption(result: DiskMap | FreeMap | RectangleMap) -> str:
    told = f"{shape_name(result)} map, conformal energy {result.conformal_energy:.3g}"
    if isinstance(result, RectangleMap):
        return f"{told}, modulus {result.modulus:.4g}"
    crosses = isinstance(result, FreeMap) and len(result.crossings)
    return f"{told}, boundary crosses itself" if crosses else told


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
