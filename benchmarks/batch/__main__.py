"""A cohort of thousands mapped by one process and by two: ``python -m benchmarks.batch`` from the repository root.

    python -m benchmarks.batch --count 2000 --folder /tmp/cohort
    python -m benchmarks.batch --count 200 --short

Three runs over the same meshes: one process without Dask, two workers, and two workers of which one is killed and which
are interrupted and begun again. All must give the same bytes. ``--short`` leaves the third out. The exit code is 1
when something that must hold does not; times are told and never judged.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from .checks import differences, told_types
from .meshes import write_cohort
from .told import markdown

LEAST, MOST, BROKEN = 1000, 20000, 0.01
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}


def parser() -> argparse.ArgumentParser:
    """The options."""
    found = argparse.ArgumentParser(
        prog="python -m benchmarks.batch", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = found.add_argument
    add("--count", type=int, default=2000, help="meshes")
    add("--workers", type=int, default=2)
    add("--map", default="disk", choices=["disk", "free", "rectangle"])
    add("--short", action="store_true", help="no killed worker and no interruption")
    add("--folder", type=Path, help="where meshes and maps go, and stay; by default a folder that is removed")
    return found


def main(arguments: list[str] | None = None) -> int:
    """Make the cohort, map it, compare and tell."""
    options = parser().parse_args(arguments)
    if options.folder is not None:
        return measured(options, options.folder)
    with tempfile.TemporaryDirectory() as folder:
        return measured(options, Path(folder))


def measured(options: argparse.Namespace, folder: Path) -> int:
    """All runs in this folder."""
    meshes = folder / "meshes"
    expected = write_cohort(meshes, options.count, least=LEAST, most=MOST, broken=BROKEN)
    runs = {"one process": run(options, meshes, folder / "one", 0)}
    runs[f"{options.workers} workers"] = run(options, meshes, folder / "many", options.workers)
    if not options.short:
        runs["killed, interrupted"] = run(options, meshes, folder / "killed", options.workers, "--kill")
    print(markdown(runs, options.count))
    wrong = told_types(folder / "one", expected)
    for name in ("many", "killed")[: len(runs) - 1]:
        wrong += differences(folder / "one", folder / name, options.count)
    print("\n".join(wrong) or "All maps and numbers are the same, each mesh has one row, each broken one its type.")
    return 1 if wrong else 0


def run(options: argparse.Namespace, meshes: Path, out: Path, workers: int, *more: str) -> dict[str, float]:
    """One run in a process of its own, which tells its figures as JSON."""
    for rows in out.glob("rows.*"):
        rows.unlink()
    command = [sys.executable, "-m", "benchmarks.batch.run", str(meshes), str(out), str(workers), options.map, *more]
    done = subprocess.run(command, env={**os.environ, **ONE_THREAD}, stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(done.stdout.splitlines()[-1])


if __name__ == "__main__":
    sys.exit(main())
