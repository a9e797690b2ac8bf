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
from matplotlib.patheffects import withStroke  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullFormatter, NullLocator  # noqa: E402

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
    closed = all(CONTESTANTS[name].closed for name in lines)
    titles = {"" if closed else "ours with CHOLMOD, its limit, other programs": first}
    titles["ours with SuperLU, its limit"] = superlu
    panels = {title: panel for title, panel in titles.items() if panel}
    if not panels:
        return False
    figure, axes = plt.subplots(
        1, len(panels), figsize=(7.6 * len(panels), 6.4), sharey=True, squeeze=False, layout="constrained"
    )
    for ax, (title, panel) in zip(axes[0], panels.items(), strict=True):
        ax.set_title(title, fontsize=10, loc="left", color="0.3")
        for name, points in panel.items():
            ax.plot(*zip(*points, strict=True), **_style(name), clip_on=False)
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_xlabel("vertices")
    axes[0][0].set_ylabel(label)
    for ax, panel in zip(axes[0], panels.values(), strict=True):  # once both panels have set the limits they share
        _ticks(ax, sorted({n for points in lines.values() for n, _ in points}))
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
    low, high = ax.get_ylim()
    ax.yaxis.set_minor_formatter(FuncFormatter(lambda value, _: f"{value:g}") if high < 15 * low else NullFormatter())
    ax.grid(True, which="major", color="0.9", linewidth=0.8)
    ax.spines[["top", "right"]].set_visible(False)


def _short(n: int) -> str:
    return f"{n / 1e6:.2g}M" if n >= 999_500 else f"{n / 1e3:.3g}k"


def _labels(ax: Axes, lines: dict[str, Points]) -> None:
    """Names beside the right ends of lines, moved apart, or at the last point of lines that end before."""
    to_axes = ax.transScale + ax.transLimits
    last = max(points[-1][0] for points in lines.values())
    whole: dict[str, tuple[float, float]] = {}
    for name, points in lines.items():
        if points[-1][0] < last:
            side = "right" if len(points) > 1 else "left"
            shift = (-5 if len(points) > 1 else 5, 5)
            text = ax.annotate(name, points[-1], shift, textcoords="offset points", ha=side, **_text_style(name))
            text.set_path_effects([withStroke(linewidth=3, foreground="white")])
        else:
            x, y = to_axes.transform(points[-1])
            whole[name] = float(x), float(y)
    names = sorted(whole, key=lambda name: whole[name][1])
    for name, height in zip(names, _apart([whole[name][1] for name in names], GAP), strict=True):
        leader = {"arrowstyle": "-", "linewidth": 0.7, "alpha": 0.6, "shrinkA": 0, "shrinkB": 3, "relpos": (0.0, 0.5)}
        ax.annotate(
            name,
            xy=whole[name],
            xycoords="axes fraction",
            xytext=(whole[name][0] + 0.08, height),
            textcoords="axes fraction",
            va="center",
            arrowprops=leader | {"color": _style(name)["color"]},
            **_text_style(name),
        )


def _text_style(name: str) -> dict[str, Any]:
    """A name in the colour of its line, ours in bold."""
    weight = "bold" if CONTESTANTS[name].group == "ours" else "normal"
    return {"color": _style(name)["color"], "fontsize": 9, "fontweight": weight}


def _apart(heights: list[float], gap: float) -> list[float]:
    """Heights in rising order, moved as little as gaps between them need, none above 1.

    Labels that touch become a block around the mean of what they asked for.
    """
    blocks: list[tuple[float, int]] = []  # middle and number of labels of each block
    for height in heights:
        middle, count = height, 1
        while blocks and middle - blocks[-1][0] < gap * (count + blocks[-1][1]) / 2:
            below, many = blocks.pop()
            middle, count = (middle * count + below * many) / (count + many), count + many
        blocks.append((middle, count))
    placed = [middle + gap * (k - (count - 1) / 2) for middle, count in blocks for k in range(count)]
    return [min(place, 1.0 - gap * (len(placed) - 1 - k)) for k, place in enumerate(placed)]
