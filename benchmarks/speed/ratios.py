"""What must hold: ratios of a run against their targets, and the power by which time grows."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from .rows import Row, cells, first_seconds, peak, spread, stage_seconds, warm_seconds

__all__ = ["Check", "checks", "power"]

MESH = "terrain"
Number = Callable[[Row], float]


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
    """

    claim: str
    target: float
    measured: float | None
    least: bool = False
    bound: bool = False
    unit: str = ""

    @property
    def verdict(self) -> str:
        """pass, miss or not measured."""
        if self.measured is None:
            return "not measured"
        held = self.measured >= self.target if self.least else self.measured <= self.target
        return "pass" if held else "not measured" if self.bound else "miss"


def power(sizes: Sequence[float], seconds: Sequence[float]) -> float:
    """The exponent of the power of the size that fits the seconds best, in the least squares of logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0])


def checks(rows: list[Row]) -> list[Check]:
    """All that must hold, on the terrain."""
    found = [*_against_limit(rows), *_against_peers(rows)]
    for method in ("linear", "newton"):
        warm = _median(rows, 10_000, f"{method}-cholmod", warm_seconds)
        found.append(Check(f"{method}, warm, 10k", 60.0, _scaled(warm, 1e3), unit="ms"))
    found += _again(rows)
    for method in ("linear", "newton"):
        most = _median(rows, 4_000_000, f"{method}-cholmod", peak)
        found.append(Check(f"{method}, memory, 4M", 24.0, _scaled(most, 1e-9), unit="GB"))
    for method in ("linear", "newton"):
        found.append(Check(f"{method}: power of growth, 262k to 4M", 1.35, _growth(rows, f"{method}-cholmod")))
    return found


def _against_limit(rows: list[Row]) -> list[Check]:
    found = []
    kinds: tuple[tuple[str, Number, dict[str, float]], ...] = (
        ("time", first_seconds, {"linear": 1.3, "newton": 2.2}),
        ("memory", peak, {"linear": 1.4, "newton": 1.4}),
    )
    for backend in ("cholmod", "superlu"):
        for name, number, targets in kinds:
            for method, target in targets.items():
                ours = _median(rows, 1_000_000, f"{method}-{backend}", number)
                for limit in (f"limit-{backend}", f"limit-{backend}-ordered"):
                    ratio = _over(ours, _median(rows, 1_000_000, limit, number))
                    found.append(Check(f"{method}-{backend} / {limit}, {name}, 1M", target, ratio))
    return found


def _against_peers(rows: list[Row]) -> list[Check]:
    found = []
    for peer in ("libigl-harmonic", "meshlab-harmonic"):
        for size, told in ((262_144, "262k"), (1_000_000, "1M")):
            ours = _median(rows, size, "linear-cholmod", first_seconds)
            theirs = _median(rows, size, peer, first_seconds)
            limit = next(filter(None, map(_time_limit, cells(rows, MESH, size, peer))), None)
            ratio = _over(theirs if limit is None else limit, ours)
            claim = f"{peer} / linear-cholmod, time, {told}"
            found.append(Check(claim, 3.0, ratio, least=True, bound=limit is not None))
    return found


def _time_limit(row: Row) -> float | None:
    """Seconds over which a row ran, or would have run, as a smaller mesh did."""
    told = re.match(r"over ([\d.]+) s\b", row.note)
    return None if told is None else float(told[1])


def _again(rows: list[Row]) -> list[Check]:
    found = []
    for method in ("linear", "newton"):
        for stage in ("again, center", "again, pins"):
            first = _median(rows, 1_000_000, f"again-{method}", stage_seconds("first"))
            ratio = _over(_median(rows, 1_000_000, f"again-{method}", stage_seconds(stage)), first)
            found.append(Check(f"{method}, {stage} / first, 1M", 3.0, _scaled(ratio, 100.0), unit="%"))
            small = _median(rows, 10_000, f"again-{method}", stage_seconds(stage))
            found.append(Check(f"{method}, {stage}, 10k", 5.0, _scaled(small, 1e3), unit="ms"))
    return found


def _growth(rows: list[Row], contestant: str) -> float | None:
    """The power over all sizes from 262k to 4M, where both ends were measured."""
    timed = {}
    for size in sorted({row.size for row in rows if row.mesh == MESH}):
        seconds = _median(rows, size, contestant, first_seconds)
        if seconds is not None and 262_144 <= size <= 4_000_000:
            timed[size] = seconds
    if not {262_144, 4_000_000} <= timed.keys():
        return None
    return power(list(timed), list(timed.values()))


def _median(rows: list[Row], size: int, contestant: str, number: Number) -> float | None:
    told = spread(cells(rows, MESH, size, contestant), number)
    return None if told is None else told.median


def _over(a: float | None, b: float | None) -> float | None:
    return None if a is None or b is None else a / b


def _scaled(value: float | None, factor: float) -> float | None:
    return None if value is None else value * factor
