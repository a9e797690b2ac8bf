"""Measure, print and save the tables: ``python -m benchmarks.speed`` from the repository root.

    python -m pip install libigl pymeshlab lapy trimesh meshio matplotlib
    python -m benchmarks.speed --scans david.obj human_face.obj --blender-python PATH
    python -m benchmarks.speed --meshes terrain irregular --sizes 1000 10000 --contestants ours limit

Rows are added to rows.jsonl in the output folder as they come; tables.md and the plots are made of them at the end.
"""

from __future__ import annotations

import argparse
import contextlib
import importlib.metadata
import importlib.util
import os
import platform
import sys
import tempfile
from pathlib import Path

from .contestants import CONTESTANTS, named
from .families import FAMILIES, chosen
from .rows import Row, read_rows
from .runner import Plan, Runner
from .table import markdown, seconds

LIBRARIES = ("numpy", "scipy", "cvxopt", "libigl", "pymeshlab", "lapy", "trimesh", "meshio", "bpy")


class OptionError(Exception):
    """Options that do not fit."""


def parser() -> argparse.ArgumentParser:
    """The options."""
    found = argparse.ArgumentParser(
        prog="python -m benchmarks.speed", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = found.add_argument
    add("--meshes", nargs="+", default=[], metavar="NAME", help=f"default: all. {', '.join(FAMILIES)}, scans by file")
    add("--scans", type=Path, nargs="+", default=[], metavar="FILE", help="meshes to subdivide, a family each")
    add("--sizes", type=int, nargs="+", default=[], help="vertices, or islands, instead of each family's own")
    add("--contestants", nargs="+", default=[], metavar="NAME", help="names or groups: ours, again, limit, peer")
    add("--repeats", type=int, default=3, help="processes for each mesh and contestant, one if it takes over 45 s")
    add("--calls", type=int, default=5, help="calls within a process on meshes up to 100 000 vertices")
    add("--time-limit", type=float, default=300.0, help="seconds for a process")
    add("--memory-limit", type=float, default=0.0, metavar="GB", help="for a process")
    add("--touch", type=float, default=0.0, metavar="GB", help="used and freed before each process of a big mesh")
    add("--blender-python", default=sys.executable, metavar="PATH", help="a Python that has bpy")
    add("--out", type=Path, default=Path("benchmarks/results"), help="folder of rows.jsonl, tables.md and the plots")
    add("--scratch", type=Path, help="folder for meshes while they are used; the system's for temporary files")
    add("--resume", action="store_true", help="go on with the rows that the output folder has")
    add("--report", action="store_true", help="measure nothing, make the tables of the rows there are")
    add("--list", action="store_true", help="name the contestants and what they need")
    return found


def main() -> None:
    """Run and tell."""
    commands = parser()
    options = commands.parse_args()
    if options.list:
        for contestant in CONTESTANTS.values():
            needs = f"  needs {contestant.needs}" if contestant.needs else ""
            print(f"{contestant.name:24}{contestant.group:8}{needs}")
        return
    rows = options.out / "rows.jsonl"
    if rows.exists() and not (options.resume or options.report):
        commands.error(f"{rows} is there already: --resume goes on with it, --report makes its tables")
    options.out.mkdir(parents=True, exist_ok=True)
    if not options.report:
        try:
            measure(options, rows)
        except OptionError as error:
            commands.error(str(error))
    report(options.out, read_rows(rows))


def measure(options: argparse.Namespace, rows: Path) -> None:
    """Run what the options ask for, a line for each row."""
    try:
        contestants = named(options.contestants)
        families = chosen(options.meshes, options.sizes, options.scans)
    except KeyError as error:
        raise OptionError(error.args[0]) from None
    with tempfile.TemporaryDirectory(dir=options.scratch) as scratch:
        plan = Plan(
            families=families,
            contestants=contestants,
            rows=rows.resolve(),
            scratch=Path(scratch),
            repeats=options.repeats,
            calls=options.calls,
            time_limit=options.time_limit,
            memory_limit=options.memory_limit,
            touch=options.touch,
            blender_python=options.blender_python,
        )
        for row in Runner(plan).run():
            print(told(row), flush=True)


def told(row: Row) -> str:
    """A row as a line of the log."""
    where = f"{row.mesh:16}{row.n:>10,} {row.contestant:24}{row.repeat + 1:>2}"
    if row.status != "ok":
        return f"{where}  {row.note}"
    return f"{where}  {seconds(row.calls[0]['seconds']):>10}  {row.peak / 1e6:>8.0f} MB"


def about() -> str:
    """What ran, and on what."""
    versions = [f"Python {platform.python_version()}"]
    for name in LIBRARIES:
        if importlib.util.find_spec({"libigl": "igl"}.get(name, name)) is not None:
            versions.append(f"{name} {importlib.metadata.version(name)}")
    with contextlib.suppress(OSError, StopIteration):
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        versions.append(next(line.partition(": ")[2] for line in lines if line.startswith("model name")))
    return f"{', '.join(versions)}; {os.cpu_count()} processors."


def report(folder: Path, rows: list[Row]) -> None:
    """Print and save the tables, draw the plots where there is matplotlib."""
    text = markdown(rows, about())
    (folder / "tables.md").write_text(text, encoding="utf-8")
    print(f"\n{text}")
    if importlib.util.find_spec("matplotlib") is None:
        print("No plots: pip install matplotlib")
        return
    from .plots import draw

    for path in draw(rows, folder):
        print(path)


if __name__ == "__main__":
    main()
