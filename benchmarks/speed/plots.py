"""Time and peak memory against vertices, on logarithmic axes, a picture for each family of meshes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import matplotlib

from .contestants import CONTESTANTS
from .rows import Row, cells, first_seconds, peak, spread

matplotlib.use("Agg")

from matplotlib import pyplot as plt  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullLocator  # noqa: E402

__all__ = ["draw"]

Points = list[tuple[int, float]]

# Colours of Okabe and Ito, which colour-blind readers tell apart.
BLACK, ORANGE, SKY, GREEN, BLUE, VERMILLION, PURPLE = (
    "#000000",
    "#E69F00",
    "#56B4E9",
    "#009E73",
    "#0072B2",
    "#D55E00",
    "#CC79A7",
)
COLOURS = {
    "linear": BLUE,
    "newton": VERMILLION,
    "sphere-linear": BLUE,
    "sphere-newton": VERMILLION,
    "limit": BLACK,
    "libigl": GREEN,
    "meshlab": PURPLE,
    "blender": ORANGE,
    "bff": SKY,
    "lapy": GREEN,
}
MARKERS = {"harmonic": "o", "conformal": "o", "lscm": "s", "angle": "s"}
GAP = 0.042  # of the axis, between labels


def draw(rows: list[Row], folder: Path) -> list[Path]:
    """The pictures' paths."""
    drawn = []
    for mesh in dict.fromkeys(row.mesh for row in rows):
        here = [row for row in rows if row.mesh == mesh]
        for name, number, label in (
            ("time", first_seconds, "seconds"),
            ("memory", lambda row: peak(row) / 1e9, "peak memory, GB"),
        ):
            path = folder / f"{mesh}-{name}.png"
            if _picture(here, number, label, path):
                drawn.append(path)
    return drawn


def _picture(rows: list[Row], number: Callable[[Row], float], label: str, path: Path) -> bool:
    """One picture: a panel for CHOLMOD and the peers, one for SuperLU where it was run."""
    lines = {name: points for name in CONTESTANTS if (points := _points(rows, name, number))}
    again = {name for name in lines if CONTESTANTS[name].group == "again"}
    superlu = {name: lines[name] for name in lines if "superlu" in name}
    first = {name: lines[name] for name in lines if name not in superlu and name not in again}
    panels = [panel for panel in (first, superlu) if panel]
    if not panels:
        return False
    figure, axes = plt.subplots(
        1, len(panels), figsize=(7.6 * len(panels), 6.4), sharey=True, squeeze=False, layout="constrained"
    )
    for ax, panel in zip(axes[0], panels, strict=True):
        for name, points in panel.items():
            ax.plot(*zip(*points, strict=True), **_style(name), clip_on=False)
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_xlabel("vertices")
        _ticks(ax, sorted({n for points in lines.values() for n, _ in points}))
    axes[0][0].set_ylabel(label)
    for ax, panel in zip(axes[0], panels, strict=True):
        _labels(ax, panel)
    figure.suptitle(f"{rows[0].mesh}: {label}, median over processes")
    figure.savefig(path, dpi=150)
    plt.close(figure)
    return True


def _points(rows: list[Row], name: str, number: Callable[[Row], float]) -> Points:
    """Vertices and median of each size that came to an end."""
    found = []
    for size, n in sorted({(row.size, row.n) for row in rows}):
        told = spread(cells(rows, rows[0].mesh, size, name), number)
        if told is not None:
            found.append((n, told.median))
    return found


def _style(name: str) -> dict[str, Any]:
    """Ours thick, the limit dashed (dotted in our order), peers thin."""
    group = CONTESTANTS[name].group
    colour = next(colour for key, colour in COLOURS.items() if name.startswith(key))
    style: dict[str, Any] = {"color": colour, "linewidth": 1.2, "markersize": 4.5}
    if group == "ours":
        return style | {"linewidth": 2.6, "marker": "o", "markersize": 5, "zorder": 4}
    if group == "limit":
        return style | {"linewidth": 1.6, "linestyle": ":" if name.endswith("ordered") else "--", "zorder": 5}
    marker = next((marker for key, marker in MARKERS.items() if name.endswith(key)), "o")
    return style | {"marker": marker, "markerfacecolor": "white"}


def _ticks(ax: Axes, sizes: Sequence[int]) -> None:
    """Vertices that were run, where there is room for their number."""
    kept: list[int] = []
    for n in sizes:
        if not kept or n > 1.6 * kept[-1]:
            kept.append(n)
    ax.set_xticks(kept, [_short(n) for n in kept])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.grid(True, which="major", color="0.9", linewidth=0.8)
    ax.spines[["top", "right"]].set_visible(False)


def _short(n: int) -> str:
    return f"{n / 1e6:.2g}M" if n >= 999_500 else f"{n / 1e3:.3g}k"


def _labels(ax: Axes, lines: dict[str, Points]) -> None:
    """Names at the right ends of lines, moved apart, each with a leader to its line."""
    to_axes = ax.transScale + ax.transLimits
    ends = {name: to_axes.transform(points[-1]) for name, points in lines.items()}
    names = sorted(ends, key=lambda name: ends[name][1])
    heights = _apart([float(ends[name][1]) for name in names], GAP)
    for name, height in zip(names, heights, strict=True):
        colour = _style(name)["color"]
        ax.annotate(
            name,
            xy=tuple(ends[name]),
            xycoords="axes fraction",
            xytext=(1.05, height),
            textcoords="axes fraction",
            color=colour,
            va="center",
            fontsize=9,
            fontweight="bold" if CONTESTANTS[name].group == "ours" else "normal",
            arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.6, "alpha": 0.5, "shrinkA": 1, "shrinkB": 4},
        )


def _apart(heights: list[float], gap: float) -> list[float]:
    """Heights in rising order moved as little as their gaps need: blocks of labels that touch keep their mean."""
    blocks: list[tuple[float, int]] = []  # middle and number of labels of each block
    for height in heights:
        middle, count = height, 1
        while blocks and middle - blocks[-1][0] < gap * (count + blocks[-1][1]) / 2:
            below, many = blocks.pop()
            middle, count = (middle * count + below * many) / (count + many), count + many
        blocks.append((middle, count))
    return [middle + gap * (k - (count - 1) / 2) for middle, count in blocks for k in range(count)]
