"""What was measured, as JSON lines: a row for each map, a row for each change of a mesh."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TypeVar

__all__ = ["ChangeRow", "MapRow", "append_row", "read_rows"]


@dataclass(frozen=True)
class MapRow:
    """A mesh by a method; `error` is the type of what was raised, and then the numbers are none.

    `mean`, `rms` and `largest` are angle errors in degrees, `off` the greatest distance of what belongs on the circle
    or the sphere from it, `chosen` the result's own name of the method.
    """

    mesh: str
    shape: str
    vertices: int
    method: str
    mean: float = float("nan")
    rms: float = float("nan")
    largest: float = float("nan")
    folds: int = 0
    off: float = 0.0
    seconds: float = float("nan")
    chosen: str = ""
    status: str = ""
    error: str = ""


@dataclass(frozen=True)
class ChangeRow:
    """The default map of a mesh and of the changed mesh: methods, and by how much the mean angle error differs."""

    mesh: str
    change: str
    before: str
    after: str
    difference: float


R = TypeVar("R", MapRow, ChangeRow)


def append_row(path: Path, row: MapRow | ChangeRow) -> None:
    """Add a line to the file."""
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps(asdict(row)) + "\n")


def read_rows(path: Path, kind: type[R]) -> list[R]:
    """All rows of a file; a last line that was cut off is left out."""
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True) if path.exists() else []
    return [kind(**json.loads(line)) for line in lines if line.endswith("\n")]
