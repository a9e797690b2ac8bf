"""The tables of a run in Markdown."""

from __future__ import annotations

import statistics
from collections.abc import Callable, Iterable

from .contestants import CONTESTANTS
from .ratios import Check, checks
from .rows import Row, Spread, cells, first_seconds, peak, spread, warm_seconds

__all__ = ["markdown"]

Lines = list[str]

NOTES = """\
Each process loads the arrays, runs once on a mesh of 400 vertices, and is then timed from arrays in memory to the map;
the median of the processes, in brackets the least and the greatest. The contestants of a mesh run in turn, and all of
them once before any runs again; what takes over 45 s runs once. *limit* is the bare factorization of the same matrix by
the same library and three solves: in the library's own ordering, and *ordered*, in the one that ours finds, which is
given to it (the time to find it counts in ours only); what must hold is held against the cheaper one. Its brackets are
of the ratios within each repeat. Peak memory is that of the whole process: interpreter, libraries and input included.
Newton ends at a projected gradient of 1e-6 of its first. Energy is the conformal energy over the area of the image; off
circle is the greatest distance of a boundary vertex from the unit circle (for closed meshes of a vertex from the unit
sphere). Blender keeps UVs in single precision; of its unwrap and our add-on's the operator alone counts in what must
hold. libigl's and MeshLab's harmonic maps put the boundary on the circle by arc length, and keep no angles.

*terrain* is a jittered grid; *irregular* points by chance, numbered as they fell, 17 % of the cotangent weights
negative; *round* a mask; scans are cut finer at the midpoints of their edges, closed ones also opened at a vertex.
Islands are grids of 2 x 2 or 5 x 5 vertices, no two alike, split, mapped and packed; *one-disk* is the linear map of a
terrain of as many vertices. Of the stages, *system* is the share of the time that the machine's system takes, nearly
all of it to hand out memory: the machine's part in a ratio."""


def markdown(rows: list[Row], about: str) -> str:
    """Everything as one text."""
    lines: Lines = ["# Speed, memory and quality, side by side", "", about, "", NOTES, ""]
    lines += ["## What must hold", "", *_checks(checks(rows)), ""]
    for mesh in dict.fromkeys(row.mesh for row in rows):
        here = [row for row in rows if row.mesh == mesh]
        lines += [f"## {mesh}", ""]
        once = [row for row in here if CONTESTANTS[row.contestant].group != "again"]
        lines += ["### Seconds", "", *_table(once, lambda cell: _spread(spread(cell, first_seconds), seconds)), ""]
        lines += ["### Peak memory", "", *_table(once, lambda cell: _spread(spread(cell, peak), gigabytes)), ""]
        lines += _warm(once) + _quality(once) + _stages(here)
    return "\n".join(lines).rstrip() + "\n"


def seconds(value: float, like: float | None = None) -> str:
    """Three digits, in ms below a second; in the unit of `like`, without its name, where that is given."""
    small = (value if like is None else like) < 0.9995
    value = value * 1e3 if small else value
    number = f"{value:.0f}" if value >= 99.95 else f"{value:.3g}"
    return number if like is not None else f"{number} {'ms' if small else 's'}"


def gigabytes(value: float, like: float | None = None) -> str:
    """In GB, or in MB below one; in the unit of `like`, without its name, where that is given."""
    small = (value if like is None else like) < 1e9
    number = f"{value / 1e6:.0f}" if small else f"{value / 1e9:.2f}"
    return number if like is not None else f"{number} {'MB' if small else 'GB'}"


def _spread(told: Spread | None, text: Callable[..., str]) -> str:
    """Median and, where they can be told apart, least and greatest."""
    if told is None:
        return ""
    low, high = text(told.low, told.median), text(told.high, told.median)
    return text(told.median) if low == high else f"{text(told.median)} [{low} .. {high}]"


def _rule(header: Iterable[str]) -> Lines:
    names = list(header)
    return [f"| {' | '.join(names)} |", f"|---|{'---:|' * (len(names) - 1)}"]


def _line(fields: Iterable[str]) -> str:
    return f"| {' | '.join(fields)} |"


def _sizes(rows: list[Row]) -> dict[int, int]:
    """Vertices of each size."""
    return {row.size: row.n for row in sorted(rows, key=lambda row: row.size)}


def _names(rows: list[Row]) -> list[str]:
    """Contestants in their order."""
    present = {row.contestant for row in rows}
    return [name for name in CONTESTANTS if name in present]


def _table(rows: list[Row], text: Callable[[list[Row]], str]) -> Lines:
    """A line for each contestant, a column for each size; why not, where there is no number."""
    sizes = _sizes(rows)
    lines = _rule(["vertices", *(f"{n:,}" for n in sizes.values())])
    for name in _names(rows):
        fields = []
        for size in sizes:
            cell = [row for row in rows if (row.size, row.contestant) == (size, name)]
            why = next((row.note for row in cell if row.note), "")
            number = text(cell)
            fields.append(f"{number} ({why})" if number and why else number or why)
        lines.append(_line([name, *fields]))
    return lines


def _warm(rows: list[Row]) -> Lines:
    """Median of the calls within a process, where there were several."""
    small = [row for row in rows if len(row.calls) > 1]
    if not small:
        return []
    return ["### Warm", "", *_table(small, lambda cell: _spread(spread(cell, warm_seconds), seconds)), ""]


def _quality(rows: list[Row]) -> Lines:
    """What the maps are worth."""
    order = list(CONTESTANTS)
    lines = _rule(["", "vertices", "angle error, mean", "max", "energy", "flips", "off circle"])
    for row in sorted((row for row in rows if row.quality), key=lambda row: (row.size, order.index(row.contestant))):
        q = row.quality
        if "not_finite" in q:
            fields = [f"{q['not_finite']:.0f} vertices are not finite", "", "", f"{q['flips']:.0f}", ""]
        else:
            free = CONTESTANTS[row.contestant].target == "free"
            angles = (f"{q['angle_mean']:.4f}°", f"{q['angle_max']:.1f}°")
            off = "free" if free else f"{q['off_circle']:.1e}"
            fields = [*angles, f"{q['energy']:.3e}", f"{q['flips']:.0f}", off]
        lines.append(_line([row.contestant, f"{row.n:,}", *fields]))
    return ["### Quality", "", *lines, ""] if len(lines) > 2 else []


def _stages(rows: list[Row]) -> Lines:
    """Where the time goes, ours and the limit's."""
    staged = [row for row in rows if row.status == "ok" and CONTESTANTS[row.contestant].group != "peer"]
    names = list(dict.fromkeys(name for row in staged for name in row.calls[0]["stages"]))
    later = [name for name in dict.fromkeys(name for row in staged for name in row.later) if name != "residual"]
    if not names:
        return []
    lines = _rule(["", "vertices", *names, *(f"({name})" for name in later), "CPU / time", "system / time"])
    for size, n in _sizes(staged).items():
        for name in _names(staged):
            cell = cells(staged, rows[0].mesh, size, name)
            if not cell:
                continue
            told = [_median([row.calls[0]["stages"].get(stage) for row in cell]) for stage in names]
            told += [_median([row.later.get(key, {}).get("seconds") for row in cell]) for key in later]
            for what in ("cpu", "system"):
                told.append(_median([row.calls[0][what] / row.calls[0]["seconds"] for row in cell], "{:.2f}".format))
            lines.append(_line([name, f"{n:,}", *told]))
    return ["### Stages", "", *lines, ""]


def _median(values: list[float | None], text: Callable[[float], str] = seconds) -> str:
    """Of the numbers that there are."""
    there = [value for value in values if value is not None]
    return text(statistics.median(there)) if there else ""


def _checks(found: list[Check]) -> Lines:
    lines = _rule(["", "target", "measured", ""])
    for check in found:
        unit = f" {check.unit}" if check.unit else ""
        target = f"{'>=' if check.least else '<='} {check.target:g}{unit}"
        target += "" if check.goal is None else f" (goal {check.goal:g})"
        measured = "" if check.measured is None else f"{'> ' if check.bound else ''}{check.measured:.3g}{unit}"
        measured += "" if check.span is None else f" [{check.span[0]:.3g} .. {check.span[1]:.3g}]"
        lines.append(_line([check.claim, target, measured, check.verdict]))
    return lines
