"""One line for each process of a run, kept as JSON lines."""

from __future__ import annotations

import json
import statistics
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

__all__ = ["Row", "Spread", "append_row", "cells", "first_seconds", "peak", "read_rows", "spread", "stage_seconds"]
__all__ += ["warm_seconds"]


@dataclass
class Row:
    """What a process told.

    Attributes
    ----------
    mesh, size, n, m
        Family, size asked for, vertices, faces.
    contestant, repeat
    status : {"ok", "over", "failed", "not installed", "skipped"}
    note : str
        Why not.
    calls : list of dict
        For each call in the process: seconds, cpu (seconds of all threads) and how many of them the system's, stages
        (seconds by name).
    before, peak : int
        Bytes resident just before the call (0 where the system does not tell), and at most up to its end.
    later : dict
        What was computed after the clock stopped, with its seconds.
    quality : dict
        As `quality.quality` returns it; of the first repeat.
    """

    mesh: str
    size: int
    n: int
    m: int
    contestant: str
    repeat: int
    status: str
    note: str = ""
    calls: list[dict[str, Any]] = field(default_factory=list)
    before: int = 0
    peak: int = 0
    later: dict[str, dict[str, float]] = field(default_factory=dict)
    quality: dict[str, float] = field(default_factory=dict)

    @property
    def key(self) -> tuple[str, int, str, int]:
        """What it is a row of."""
        return self.mesh, self.size, self.contestant, self.repeat


@dataclass(frozen=True)
class Spread:
    """Median, least and greatest of some repeats."""

    median: float
    low: float
    high: float


def append_row(path: Path, row: Row) -> None:
    """Add a line to the file."""
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps(asdict(row)) + "\n")


def read_rows(path: Path) -> list[Row]:
    """All rows of a file; a last line that was cut off is left out."""
    rows = []
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    for number, line in enumerate(lines, start=1):
        try:
            rows.append(Row(**json.loads(line)))
        except json.JSONDecodeError:
            if number < len(lines):
                raise
    return rows


def cells(rows: Iterable[Row], mesh: str, size: int, contestant: str) -> list[Row]:
    """The repeats of one cell of a table."""
    return [row for row in rows if (row.mesh, row.size, row.contestant) == (mesh, size, contestant)]


def spread(rows: Iterable[Row], number: Callable[[Row], float]) -> Spread | None:
    """Of the rows that came to an end; None where there are none."""
    values = [number(row) for row in rows if row.status == "ok"]
    return Spread(statistics.median(values), min(values), max(values)) if values else None


def first_seconds(row: Row) -> float:
    """Seconds of the first call after the warm-up."""
    return float(row.calls[0]["seconds"])


def warm_seconds(row: Row) -> float:
    """Median seconds of all calls in the process."""
    return statistics.median(float(call["seconds"]) for call in row.calls)


def peak(row: Row) -> float:
    """Peak memory in bytes."""
    return float(row.peak)


def stage_seconds(name: str) -> Callable[[Row], float]:
    """Median seconds of a stage over the calls in a process."""
    return lambda row: statistics.median(float(call["stages"].get(name, 0.0)) for call in row.calls)
