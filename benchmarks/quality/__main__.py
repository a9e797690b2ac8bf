"""Map every mesh by every method and write what came out: ``python -m benchmarks.quality`` from the repository root.

    python -m benchmarks.quality --data FOLDER --out docs/quality.md
    python -m benchmarks.quality --only icosphere hull --invariance

Rows are added to maps.jsonl and changes.jsonl in the folder of rows as they come. The exit code is 1 when something
that must hold does not.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from .checks import violations
from .measure import METHODS, is_disk, measured, unchanged
from .meshes import Maker, all_meshes
from .peers import read_peers
from .rows import ChangeRow, MapRow, append_row, read_rows
from .table import markdown

DATA = Path(os.environ.get("CONFORMAL_UV_DATA") or Path(__file__).resolve().parents[3] / "shared" / "data")


def parser() -> argparse.ArgumentParser:
    """The options."""
    found = argparse.ArgumentParser(
        prog="python -m benchmarks.quality", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = found.add_argument
    add("--data", type=Path, default=DATA, help="folder of OBJ files; default: CONFORMAL_UV_DATA")
    add("--only", nargs="+", default=[], metavar="TEXT", help="meshes with one of these in their name")
    add("--maps", action="store_true", help="only the maps, no changed meshes")
    add("--invariance", action="store_true", help="only the changed meshes: ten similarities and renumberings of each")
    add("--time-limit", type=float, default=300.0, help="seconds for a map")
    add("--rows", type=Path, default=Path("benchmarks/results/quality"), help="folder of the rows")
    add("--out", type=Path, help="file for the tables, such as docs/quality.md")
    add("--resume", action="store_true", help="go on with the rows that the folder has")
    add("--report", action="store_true", help="measure nothing, tell of the rows there are")
    return found


def main(arguments: list[str] | None = None) -> int:
    """Measure what has no row yet, tell and write."""
    commands = parser()
    options = commands.parse_args(arguments)
    maps, changes = options.rows / "maps.jsonl", options.rows / "changes.jsonl"
    if (maps.exists() or changes.exists()) and not (options.resume or options.report):
        commands.error(f"{options.rows} has rows already: --resume goes on with them, --report tells of them")
    if not options.report:
        options.rows.mkdir(parents=True, exist_ok=True)
        if not options.data.is_dir():
            print("No folder of meshes: set CONFORMAL_UV_DATA or give --data; going on with generated ones.")
        meshes = all_meshes(options.data if options.data.is_dir() else None)
        chosen = {name: make for name, make in meshes.items() if _wanted(name, options.only)}
        if not options.invariance:
            measure_maps(chosen, maps, options.time_limit)
        if not options.maps:
            measure_changes(chosen, changes, options.time_limit)
    return report(read_rows(maps, MapRow), read_rows(changes, ChangeRow), options)


def _wanted(name: str, texts: list[str]) -> bool:
    return not texts or any(text in name for text in texts)


def measure_maps(meshes: dict[str, Maker], path: Path, limit: float) -> None:
    """A row for each mesh and method that has none."""
    done = {(row.mesh, row.method) for row in read_rows(path, MapRow)}
    for name, make in meshes.items():
        try:
            mesh = make()
        except ValueError as error:
            print(f"{name}: left out, {error}", flush=True)
            continue
        for method in METHODS["disk" if is_disk(mesh[1]) else "sphere"]:
            if (name, method) not in done:
                row = measured(name, mesh, method, limit)
                append_row(path, row)
                print(f"{name:44} {method:8} {row.error or f'{row.mean:8.3f} {row.folds:6} {row.status}'}", flush=True)


def measure_changes(meshes: dict[str, Maker], path: Path, limit: float) -> None:
    """Rows for each mesh that has not all of them."""
    done = {(row.mesh, row.change) for row in read_rows(path, ChangeRow)}
    for name, make in meshes.items():
        if (name, "all of these") in done:
            continue
        try:
            mesh = make()
        except ValueError:
            continue
        for row in unchanged(name, mesh, limit):
            if (name, row.change) not in done:
                append_row(path, row)
                print(f"{name:44} {row.change:40} {row.before:8} {row.after:8} {row.difference:.1e}", flush=True)


def report(maps: list[MapRow], changes: list[ChangeRow], options: argparse.Namespace) -> int:
    """Write the tables, print what does not hold, and tell whether all does."""
    if options.out is not None:
        text = markdown(maps, changes, read_peers(options.data))
        options.out.write_text(text, encoding="utf-8")
    broken = violations(maps, changes)
    for violation in broken:
        print(f"{violation.check}\n    {violation.mesh}: {violation.told}")
    print(f"{len(maps)} maps, {len(changes)} changed meshes, {len(broken)} exceptions to what must hold")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
