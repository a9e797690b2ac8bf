"""Time and peak memory against vertices, on logarithmic axes, a picture for each family of meshes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import matplotlib

from .contestants import CONTESTANTS
from .families import FAMILIES
from .rows import Row, cells, first_seconds, peak, spread

matplotlib.use("Agg")

from matplotlib import pyplot as plt  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullFormatter, NullLocator  # noqa: E402

__all__ = ["draw"]

Points = list[tuple[int, float]]

# By how names begin; of Okabe and Ito, whose colours colour-blind readers tell apart.
COLOURS = {
    **dict.fromkeys(("linear", "sphere-linear"), "#0072B2"),
    **dict.fromkeys(("newton", "sphere-newton"), "#D55E00"),
    **dict.fromkeys(("libigl", "lapy"), "#009E73"),
    **dict.fromkeys(("meshlab", "filter"), "#CC79A7"),
    "blender": "#E69F00",
    "limit": "#000000",
}
MARKERS = {"harmonic": "o", "conformal": "o", "lscm": "s", "angle": "s"}


def draw(rows: list[Row], folder: Path) -> list[Path]:
    """The pictures' paths."""
    drawn = []
    for mesh in dict.fromkeys(row.mesh for row in rows):
        if mesh in FAMILIES and FAMILIES[mesh].kind not in ("disk", "closed"):
            continue
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
    """One picture: ours with CHOLMOD, its limit, the peers."""
    shown = [name for name in CONTESTANTS if "superlu" not in name and CONTESTANTS[name].group != "again"]
    lines = {name: points for name in shown if (points := _points(rows, name, number))}
    if not lines:
        return False
    figure, ax = plt.subplots(figsize=(8.2, 5.6), layout="constrained")
    for name, points in lines.items():
        ax.plot(*zip(*points, strict=True), **_style(name), clip_on=False, label=name)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlabel("vertices")
    ax.set_ylabel(label)
    _ticks(ax, sorted({n for points in lines.values() for n, _ in points}))
    ax.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, fontsize=9, handlelength=3.0)
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
    ax.set_xticks(kept, [f"{n / 1e6:.2g}M" if n >= 999_500 else f"{n / 1e3:.3g}k" for n in kept])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    low, high = ax.get_ylim()
    ax.yaxis.set_minor_formatter(FuncFormatter(lambda value, _: f"{value:g}") if high < 15 * low else NullFormatter())
    ax.grid(True, which="major", color="0.9", linewidth=0.8)
    ax.spines[["top", "right"]].set_visible(False)
