"""Runs every contestant on every mesh, each time in a fresh process, the repeats interleaved."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from .contestants import Contestant
from .processes import child, module
from .rows import Row, append_row, read_rows

__all__ = ["Plan", "Runner"]

TINY = 400  # vertices of the mesh to warm up on
SMALL = 100_000  # size up to which the call is repeated within a process
BIG = 250_000  # vertices from which memory is touched before
HUGE = 1_500_000  # vertices from which there are fewer repeats


@dataclass(frozen=True)
class Plan:
    """What to run and how long.

    Attributes
    ----------
    meshes : dict
        Sizes of each family of meshes.
    contestants : list of Contestant
    rows : Path
        The JSON lines that rows are added to.
    scratch : Path
        A folder for meshes and maps; they are removed after each size.
    face : Path, optional
        File that the family "face" is subdivided from.
    repeats, huge_repeats : int
        Processes for each mesh and contestant, and for meshes over 1.5 million vertices.
    calls : int
        Calls within a process, for meshes up to 100 000 vertices.
    time_limit : float
        Seconds after which a process is ended.
    memory_limit : float
        Gigabytes that a process may take; 0 for all there are.
    touch : float
        Gigabytes that a throw-away process uses before each process of a big mesh.
    blender_python : str
        Interpreter that has bpy.
    """

    meshes: dict[str, list[int]]
    contestants: list[Contestant]
    rows: Path
    scratch: Path
    face: Path | None = None
    repeats: int = 3
    huge_repeats: int = 2
    calls: int = 5
    time_limit: float = 300.0
    memory_limit: float = 0.0
    touch: float = 0.0
    blender_python: str = sys.executable


@dataclass
class Runner:
    """Goes through a plan; rows that the file already has are not run again."""

    plan: Plan
    rows: list[Row] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.rows = read_rows(self.plan.rows)
        self._known = {row.key: row for row in self.rows}
        self._counts = 0, 0  # vertices and faces of the present mesh
        self._trouble = ""  # why a file of it is missing

    def run(self) -> Iterator[Row]:
        """Each new row as it comes."""
        for family, sizes in self.plan.meshes.items():
            racers = [c for c in self.plan.contestants if c.closed == (family == "ellipsoid")]
            if not racers:
                continue
            for size in sorted(sizes):
                yield from self._size(family, size, racers)

    def _size(self, family: str, size: int, racers: list[Contestant]) -> Iterator[Row]:
        """All rows of one mesh."""
        repeats = self.plan.repeats if size < HUGE else min(self.plan.repeats, self.plan.huge_repeats)
        open_ = [(r, c) for r in range(repeats) for c in racers if (family, size, c.name, r) not in self._known]
        if not open_:
            return
        made = self._made(family, size, any(c.group == "limit" for _, c in open_))
        for repeat, contestant in open_:
            if repeat and self._known[family, size, contestant.name, 0].status != "ok":
                continue
            why = self._hopeless(family, contestant)
            row = Row(family, size, *self._counts, contestant.name, repeat, "skipped", why)
            if not row.note:
                self._measure(row, contestant, made)
            append_row(self.plan.rows, row)
            self.rows.append(row)
            self._known[row.key] = row
            yield row
        for name in ("mesh", "mesh matrix"):
            made[name].unlink(missing_ok=True)

    def _hopeless(self, family: str, contestant: Contestant) -> str:
        """Why not even to try: what happened on a smaller mesh."""
        for row in self.rows:
            if row.contestant == contestant.name and row.status == "not installed":
                return row.note
            if (row.mesh, row.contestant, row.status) == (family, contestant.name, "over"):
                return f"{row.note} at {row.n} vertices"
        return ""

    def _made(self, family: str, size: int, with_matrix: bool) -> dict[str, Path]:
        """Files of a mesh, of a tiny one, and of their matrices."""
        folder = self.plan.scratch
        tiny = "terrain" if family == "face" else family
        self._counts = size, 0
        made = {"mesh": folder / "mesh.npz", "tiny": folder / f"tiny-{tiny}.npz"}
        for name, kind, count in (("mesh", family, size), ("tiny", tiny, TINY)):
            file = [self.plan.face] if kind == "face" else []
            made[f"{name} matrix"] = made[name].with_suffix(".matrix.npz")
            try:
                if not made[name].exists():
                    n, m = map(int, module("meshes", kind, count, made[name], *file).split())
                    self._counts = self._counts if name == "tiny" else (n, m)
                if with_matrix and not made[f"{name} matrix"].exists():
                    module("matrices", made[name], made[f"{name} matrix"])
            except RuntimeError as error:
                self._trouble = str(error)
        return made

    def _measure(self, row: Row, contestant: Contestant, made: dict[str, Path]) -> None:
        """Fill in a row."""
        matrix = " matrix" if contestant.group == "limit" else ""
        folder = self.plan.scratch
        if not made[f"mesh{matrix}"].exists() or not made[f"tiny{matrix}"].exists():
            row.status, row.note = "failed", self._trouble
            return
        map_file = folder / "map.npy"
        job = {
            "module": contestant.module,
            "options": contestant.options,
            "input": str(made[f"mesh{matrix}"]),
            "warm_up": str(made[f"tiny{matrix}"]),
            "calls": self.plan.calls if row.size <= SMALL else 1,
            "map": str(map_file),
            "told": str(folder / "told.json"),
        }
        if self.plan.touch and row.n >= BIG:
            module("touch", self.plan.touch)
        python = self.plan.blender_python if contestant.blender else sys.executable
        told = child(python, job, folder / "job.json", self.plan.time_limit, self.plan.memory_limit)
        if told["status"] == "not installed":
            told["note"] = f"not installed ({contestant.needs or told['note']})"
        for name, value in told.items():
            setattr(row, name, value)
        if row.status == "ok" and row.repeat == 0 and contestant.target != "none":
            try:
                row.quality = json.loads(module("quality", made["mesh"], map_file))
            except RuntimeError as error:
                row.note = str(error)
        map_file.unlink(missing_ok=True)
