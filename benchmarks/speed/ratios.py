"""What must hold: ratios of a run against their targets, and the power by which time grows."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from .contestants import READERS
from .families import FAMILIES, TERRAINS
from .rows import Row, cells, first_seconds, peak, spread, stage_seconds, warm_seconds

__all__ = ["Check", "checks", "power"]

Number = Callable[[Row], float]
NO_MAP = ("read", "distortion", "write", "numbers")  # stages of the command
SMALL = (("linear", 1.6, None), ("newton", 3.0, None))  # most that they may take of the limit, and the goal beyond it
LARGE = (("linear", 1.5, 1.3), ("newton", 2.5, 2.2))
HARMONIC, BUILT_IN = "meshlab-harmonic", ("blender-conformal", "blender-angle")


@dataclass(frozen=True)
class Check:
    """A measured number and the most, or the least, that it may be.

    Attributes
    ----------
    claim : str
    target, measured : float
        `measured` is None where the run has not what it takes.
    least : bool
        The target is a lower bound.
    bound : bool
        `measured` is itself a lower bound: what it divides ran over the time limit.
    unit : str
    goal : float, optional
        What is wanted beyond the target.
    span : pair of float, optional
        Least and greatest of the ratios of single repeats, which ran one after the other.
    """

    claim: str
    target: float
    measured: float | None
    least: bool = False
    bound: bool = False
    unit: str = ""
    goal: float | None = None
    span: tuple[float, float] | None = None

    @property
    def verdict(self) -> str:
        """pass, miss or not measured."""
        if self.measured is None:
            return "not measured"
        held = self.measured >= self.target if self.least else self.measured <= self.target
        return "pass" if held else "not measured" if self.bound else "miss"


@dataclass(frozen=True)
class Cheapest:
    """A number of the one that has the least of it, of some contestants on a mesh."""

    mesh: str
    size: int
    names: tuple[str, ...]
    number: Number = first_seconds

    def of(self, rows: list[Row]) -> tuple[float | None, bool]:
        """Its median, and whether that is the time limit, over which all of them ran."""
        here = [cells(rows, self.mesh, self.size, name) for name in self.names]
        medians = [told.median for cell in here if (told := spread(cell, self.number))]
        limits = [limit for cell in here for row in cell if (limit := _time_limit(row))]
        return (min(medians), False) if medians else (min(limits, default=None), bool(limits))

    def repeats(self, rows: list[Row]) -> dict[int, float]:
        """By repeat."""
        found: dict[int, float] = {}
        for row in (row for name in self.names for row in cells(rows, self.mesh, self.size, name)):
            if row.status == "ok":
                found[row.repeat] = min(self.number(row), found.get(row.repeat, np.inf))
        return found


def power(sizes: Sequence[float], seconds: Sequence[float]) -> float:
    """The exponent of the power of the size that fits the seconds best, in the least squares of logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0])


def checks(rows: list[Row]) -> list[Check]:
    """All that must hold."""
    parts = (_limit, _peers, _atlases, _files, _blender, _terrain)
    return [check for part in parts for check in part(rows)]


def _limit(rows: list[Row]) -> Iterator[Check]:
    """Against the bare factorization, in the library's own order or in ours, whichever is cheaper."""
    scans = {row.mesh: row.size for row in sorted(rows, key=lambda row: row.size) if row.mesh not in FAMILIES}
    mapped = {row.mesh for row in rows if row.contestant == "linear-cholmod"}
    places = [(mesh, size, "cholmod") for mesh in TERRAINS for size in (10_000, 490_000, 1_000_000)]
    places += [(mesh, 1_000_000, "superlu") for mesh in TERRAINS]
    places += [(mesh, size, "cholmod") for mesh, size in scans.items() if mesh in mapped]
    for mesh, size, backend in places:
        names = (f"limit-{backend}", f"limit-{backend}-ordered")
        small = size <= 20_000
        for method, target, goal in SMALL if small else LARGE:
            against = f"{method}-{backend} / limit, {mesh} {_short(size)}"
            number = warm_seconds if small else first_seconds
            ours, limit = (Cheapest(mesh, size, who, number) for who in ((f"{method}-{backend}",), names))
            yield _ratio(rows, f"{against}, time", target, ours, limit, goal=goal)
            if not small:
                yield _ratio(rows, f"{against}, memory", 1.4, replace(ours, number=peak), replace(limit, number=peak))


def _peers(rows: list[Row]) -> Iterator[Check]:
    for mesh in TERRAINS:
        for ours, peer, size, target in (
            ("linear-cholmod", "libigl-harmonic", 262_144, 2.3),
            ("linear-cholmod", "libigl-harmonic", 1_000_000, 4.0),
            ("filter", HARMONIC, 1_000_000, 3.0),
        ):
            claim = f"{peer} / {ours}, {mesh} {_short(size)}"
            yield _ratio(rows, claim, target, Cheapest(mesh, size, (peer,)), Cheapest(mesh, size, (ours,)), least=True)


def _atlases(rows: list[Row]) -> Iterator[Check]:
    size = 10_000
    for mesh, target in (("islands-4", 8.0), ("islands-25", 3.0)):
        linear, default = (Cheapest(mesh, size, (f"atlas-{method}",)) for method in ("linear", "auto"))
        one = Cheapest(mesh, size, ("one-disk",))
        yield _ratio(rows, f"10k {mesh}, linear / one disk of as many vertices", target, linear, one)
        yield _ratio(rows, f"10k {mesh}, default / linear", 2.0, default, linear)
        free, built_in = Cheapest(mesh, size, ("atlas-free",)), Cheapest(mesh, size, BUILT_IN, _unwrap)
        yield _ratio(rows, f"10k {mesh}, free boundaries / linear", 2.0, free, linear)
        for name, told in (("auto", "default"), ("free", "free boundaries")):
            ours = Cheapest(mesh, size, (f"blender-ours-{name}",), _unwrap)
            yield _ratio(rows, f"10k {mesh}, in Blender, {told} / the faster built-in", 1.0, ours, built_in)
    few, many = (Cheapest("triangles", count, ("atlas-linear",)) for count in (10_000, 100_000))
    yield _ratio(rows, "triangles, linear, 100k / ten times 10k", 3.0, many, few, scale=0.1)
    fan, one = (Cheapest("fan", 100_000, (name,)) for name in ("linear-cholmod", "one-disk"))
    yield _ratio(rows, "fan of 100k, linear / terrain of as many vertices", 5.0, fan, one)


def _files(rows: list[Row]) -> Iterator[Check]:
    files, map_ = (Cheapest("files", 1_000_000, ("command",), number) for number in (_in_files, _in_map))
    yield _ratio(rows, "command, reading + writing / the map, 1M OBJ", 1.0, files, map_)
    yield _amount(rows, "reading a binary PLY, 1M", 0.5, Cheapest("files", 1_000_000, ("read-ply",)), 1.0, "s")
    peers = tuple(f"{name}-read-obj" for name in READERS)
    ours, theirs = (Cheapest("files", 1_000_000, names) for names in (("read-obj",), peers))
    yield _ratio(rows, "reading an OBJ / the fastest peer, 1M", 1.0, ours, theirs)


def _blender(rows: list[Row]) -> Iterator[Check]:
    for mesh in ("terrain", "round"):
        for method, target in (("linear", 20.0), ("newton", 10.0)):
            ours, theirs = (
                Cheapest(mesh, 200_000, (f"blender-{name}",), _unwrap) for name in (f"ours-{method}", "conformal")
            )
            yield _ratio(rows, f"blender-conformal / ours, {method}, {mesh} 200k", target, theirs, ours, least=True)


def _terrain(rows: list[Row]) -> Iterator[Check]:
    """What is asked of the regular terrain alone: seconds, asking again, memory, growth."""
    for method in ("linear", "newton"):
        ours, again = (
            partial(Cheapest, "terrain", names=(f"{name}",)) for name in (f"{method}-cholmod", f"again-{method}")
        )
        warm = ours(size=10_000, number=warm_seconds)
        yield _amount(rows, f"{method}, warm, 10k", 60.0, warm, 1e3, "ms")
        for stage in ("again, center", "again, pins"):
            one, first = (again(size=1_000_000, number=stage_seconds(name)) for name in (stage, "first"))
            yield _ratio(rows, f"{method}, {stage} / first, 1M", 3.0, one, first, scale=100.0, unit="%")
            small = again(size=10_000, number=stage_seconds(stage))
            yield _amount(rows, f"{method}, {stage}, 10k", 5.0, small, 1e3, "ms")
        most = ours(size=4_000_000, number=peak)
        yield _amount(rows, f"{method}, memory, 4M", 24.0, most, 1e-9, "GB")
        sizes = [size for size in FAMILIES["terrain"].sizes if 262_144 <= size <= 4_000_000]
        timed = [(size, found) for size in sizes if (found := ours(size=size).of(rows)[0]) is not None]
        whole = {262_144, 4_000_000} <= {size for size, _ in timed}
        growth = power(*zip(*timed, strict=True)) if whole else None
        yield Check(f"{method}: power of growth, 262k to 4M", 1.35, growth)


def _ratio(
    rows: list[Row],
    claim: str,
    target: float,
    above: Cheapest,
    below: Cheapest,
    *,
    scale: float = 1.0,
    least: bool = False,
    unit: str = "",
    goal: float | None = None,
) -> Check:
    """Medians divided by each other; a time limit counts only as a bound of what ours is compared with."""
    (a, over), (b, neither) = above.of(rows), below.of(rows)
    if a is None or b is None or neither or (over and not least):
        return Check(claim, target, None, least, unit=unit, goal=goal)
    ours, theirs = above.repeats(rows), below.repeats(rows)
    each = [scale * ours[repeat] / theirs[repeat] for repeat in ours.keys() & theirs.keys()]
    span = (min(each), max(each)) if len(each) > 1 else None
    return Check(claim, target, scale * a / b, least, over, unit, goal, span)


def _amount(rows: list[Row], claim: str, target: float, of: Cheapest, scale: float, unit: str) -> Check:
    """A median by itself."""
    found, over = of.of(rows)
    return Check(claim, target, None if found is None or over else scale * found, unit=unit)


def _time_limit(row: Row) -> float | None:
    """Seconds over which a row ran, or would have run, as a smaller mesh did."""
    told = re.match(r"over ([\d.]+) s\b", row.note)
    return None if told is None else float(told[1])


def _unwrap(row: Row) -> float:
    """The operator alone, without the mesh's way into Blender and out of it."""
    return stage_seconds("unwrap")(row)


def _in_files(row: Row) -> float:
    """Seconds of the command in reading and writing the mesh."""
    stages = row.calls[0]["stages"]
    return float(stages["read"] + stages["write"])


def _in_map(row: Row) -> float:
    """Seconds of the command in the map; its report counts neither here nor there."""
    return sum(spent for name, spent in row.calls[0]["stages"].items() if name not in NO_MAP)


def _short(size: int) -> str:
    return f"{size / 1e6:.2g}M" if size >= 999_500 else f"{size / 1e3:.0f}k"
