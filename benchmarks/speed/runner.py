"""Runs every contestant on every mesh, each time in a fresh process, the repeats interleaved."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from .contestants import Contestant
from .families import Family
from .processes import child, module
from .rows import Row, append_row, read_rows

__all__ = ["Plan", "Runner"]

SMALL = 100_000  # size up to which the call is repeated within a process
BIG = 250_000  # vertices from which memory is touched before
LONG = 45.0  # seconds of a first run after which there is no second
LOOKED_AT = ("disk", "closed", "fan")  # kinds of families whose maps have their quality measured
MAKERS = {"matrix": ("matrices", ".matrix.npz"), "obj": ("files", ".obj"), "ply": ("files", ".ply")}


@dataclass(frozen=True)
class Plan:
    """What to run and how long.

    Attributes
    ----------
    families : list of Family
    contestants : list of Contestant
    rows : Path
        The JSON lines that rows are added to.
    scratch : Path
        A folder for meshes and maps; they are removed after each size.
    repeats : int
        Processes for each mesh and contestant.
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

    families: list[Family]
    contestants: list[Contestant]
    rows: Path
    scratch: Path
    repeats: int = 3
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
        for family in self.plan.families:
            for size in sorted(family.sizes):
                fit = [c for c in self.plan.contestants if family.kind in c.kinds and size <= c.largest]
                yield from self._size(family, size, fit)

    def _size(self, family: Family, size: int, racers: list[Contestant]) -> Iterator[Row]:
        """All rows of one mesh."""
        turns = [(r, c) for r in range(self.plan.repeats) for c in racers]
        open_ = [(r, c) for r, c in turns if (family.name, size, c.name, r) not in self._known]
        if not open_:
            return
        made = self._made(family, size, {c.input for _, c in open_})
        for repeat, contestant in open_:
            first = self._known.get((family.name, size, contestant.name, 0))
            if repeat and first and (first.status != "ok" or first.calls[0]["seconds"] > LONG):
                continue
            why = self._hopeless(family.name, contestant)
            row = Row(family.name, size, *self._counts, contestant.name, repeat, "skipped", why)
            if not row.note:
                self._measure(row, contestant, made, look=family.kind in LOOKED_AT)
            append_row(self.plan.rows, row)
            self.rows.append(row)
            self._known[row.key] = row
            yield row
        for name, path in made.items():
            if name.startswith("mesh"):
                path.unlink(missing_ok=True)

    def _hopeless(self, family: str, contestant: Contestant) -> str:
        """Why not even to try: what happened on a smaller mesh."""
        for row in self.rows:
            if row.contestant == contestant.name and row.status == "not installed":
                return row.note
            if (row.mesh, row.contestant, row.status) == (family, contestant.name, "over"):
                return f"{row.note} at {row.n} vertices"
        return ""

    def _made(self, family: Family, size: int, inputs: set[str]) -> dict[str, Path]:
        """Files of a mesh and of a tiny one, and what else of them the contestants are given."""
        folder = self.plan.scratch
        self._counts, self._trouble = (size, 0), ""
        kind, few = family.tiny
        made = {"mesh": folder / "mesh.npz", "tiny": folder / f"tiny-{kind}.npz"}
        file = [] if family.file is None else [family.file]
        for name, what in (("mesh", (family.name, size, made["mesh"], *file)), ("tiny", (kind, few, made["tiny"]))):
            try:
                if not made[name].exists():
                    n, m = map(int, module("meshes", *what).split())
                    self._counts = self._counts if name == "tiny" else (n, m)
                for kind in sorted(inputs - {"mesh"}):
                    maker, suffix = MAKERS[kind]
                    path = made[f"{name} {kind}"] = made[name].with_suffix(suffix)
                    if not path.exists():
                        module(maker, made[name], path)
            except RuntimeError as error:
                self._trouble = str(error)
        return made

    def _measure(self, row: Row, contestant: Contestant, made: dict[str, Path], look: bool) -> None:
        """Fill in a row; whether to look at the map."""
        kind = "" if contestant.input == "mesh" else f" {contestant.input}"
        mesh, tiny = (made.get(f"{name}{kind}") for name in ("mesh", "tiny"))
        folder = self.plan.scratch
        if mesh is None or tiny is None or not (mesh.exists() and tiny.exists()):
            row.status, row.note = "failed", self._trouble
            return
        map_file = folder / "map.npy"
        job = {
            "module": contestant.module,
            "options": contestant.options,
            "input": str(mesh),
            "warm_up": str(tiny),
            "calls": self.plan.calls if row.size <= SMALL else 1,
            "map": str(map_file),
            "told": str(folder / "told.json"),
        }
        if self.plan.touch and row.n >= BIG:
            module("memory", self.plan.touch)
        python = self.plan.blender_python if contestant.blender else sys.executable
        told = child(python, job, folder / "job.json", self.plan.time_limit, self.plan.memory_limit)
        if told["status"] == "not installed":
            told["note"] = f"not installed ({contestant.needs or told['note']})"
        for name, value in told.items():
            setattr(row, name, value)
        if look and row.status == "ok" and row.repeat == 0 and contestant.target != "none":
            try:
                row.quality = json.loads(module("quality", made["mesh"], map_file))
            except RuntimeError as error:
                row.note = str(error)
        map_file.unlink(missing_ok=True)
