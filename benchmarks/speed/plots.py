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
        1, len(panels), figsize=(8.2 * len(panels), 5.6), sharey=True, squeeze=False, layout="constrained"
    )
    for ax, (title, panel) in zip(axes[0], panels.items(), strict=True):
        ax.set_title(title, fontsize=10, loc="left", color="0.3")
        for name, points in panel.items():
            ax.plot(*zip(*points, strict=True), **_style(name), clip_on=False, label=name)
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_xlabel("vertices")
    axes[0][0].set_ylabel(label)
    for ax, panel in zip(axes[0], panels.values(), strict=True):  # once both panels have set the limits they share
        _ticks(ax, sorted({n for points in lines.values() for n, _ in points}))
        _legend(ax, panel)
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


def _legend(ax: Axes, lines: dict[str, Points]) -> None:
    """Names beside the panel, in the order of the lines at the largest size that most of them reached."""
    shared = sorted(n for points in lines.values() for n, _ in points)[-max(len(lines), 1) :][0]
    heights = {name: min(points, key=lambda point: abs(point[0] - shared))[1] for name, points in lines.items()}
    handles = {line.get_label(): line for line in ax.get_lines()}
    names = sorted(lines, key=lambda name: -heights[name])
    legend = ax.legend(
        [handles[name] for name in names],
        names,
        loc="upper left",
        bbox_to_anchor=(1.01, 1.0),
        frameon=False,
        fontsize=9,
        handlelength=3.0,
    )
    for name, text in zip(names, legend.get_texts(), strict=True):
        text.set_fontweight("bold" if CONTESTANTS[name].group == "ours" else "normal")
