"""The measured process: ``python -m benchmarks.speed.child JOB``, a JSON file that says what to run.

It loads the arrays, runs the contestant once on a tiny mesh (imports, lazy loads), then with the clock on from arrays
to map, and writes what it measured and the map into files.
"""

from __future__ import annotations

import importlib
import json
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from .contestants.outcome import Arrays, Outcome, Stage
from .memory import die_first, peak_memory, resident_memory, system_seconds

__all__ = ["main"]

Run = Callable[..., Outcome]
REST = 0.3  # seconds for the threads of the libraries to go to sleep after the warm-up
LONGEST_REPEATING = 15.0  # seconds of calls in one process, after which there are no more


class Clock:
    """Seconds of each stage; stages of the same name add up."""

    def __init__(self) -> None:
        self.stages: dict[str, float] = {}
        self._name = ""
        self._since = time.perf_counter()

    def __call__(self, name: str) -> None:
        """A stage begins, and the one before it ends."""
        now = time.perf_counter()
        if self._name:
            self.stages[self._name] = self.stages.get(self._name, 0.0) + now - self._since
        self._name, self._since = name, now


def called(run: Run, arrays: Arrays, options: dict[str, Any]) -> tuple[dict[str, Any], Outcome]:
    """One call with the clock on."""
    clock = Clock()
    system, cpu, start = system_seconds(), time.process_time(), time.perf_counter()
    outcome = run(arrays, clock, **options)
    clock("")
    told = {
        "seconds": time.perf_counter() - start,
        "cpu": time.process_time() - cpu,
        "system": system_seconds() - system,
        "stages": outcome.stages or clock.stages,
    }
    return told, outcome


def silent(name: str) -> None:
    """A stage that nobody times."""


def loaded(path: str) -> Arrays:
    """All arrays of a file; of a mesh file its path alone."""
    if not path.endswith(".npz"):
        return {"path": np.array(path)}
    with np.load(path) as file:
        return {name: file[name] for name in file.files}


def measured(job: dict[str, Any]) -> dict[str, Any]:
    """Run a job; its numbers."""
    run: Run = importlib.import_module(f"{__package__}.contestants.{job['module']}").run
    quiet: Stage = silent
    run(loaded(job["warm_up"]), quiet, **job["options"])
    arrays = loaded(job["input"])
    time.sleep(REST)
    before = resident_memory()
    call, outcome = called(run, arrays, job["options"])
    told: dict[str, Any] = {"calls": [call], "later": {}, "before": before or 0, "peak": peak_memory()}
    spent = call["seconds"]
    for _ in range(job["calls"] - 1):
        if spent > LONGEST_REPEATING:
            break
        call, outcome = called(run, arrays, job["options"])
        told["calls"].append(call)
        spent += call["seconds"]
    for name, work in outcome.later.items():
        start = time.perf_counter()
        value = work()
        told["later"][name] = {"seconds": time.perf_counter() - start, "value": value}
    if outcome.uv is not None:
        np.save(job["map"], outcome.uv)
    return told


def main() -> None:
    """Write the numbers, or what went wrong."""
    job = json.loads(Path(sys.argv[1]).read_text())
    die_first()
    try:
        told = {"status": "ok", **measured(job)}
    except ModuleNotFoundError as error:
        told = {"status": "not installed", "note": str(error)}
    except MemoryError as error:
        told = {"status": "failed", "note": f"out of memory {error}".strip()}
    except Exception as error:  # whatever a contestant does wrong is its result
        told = {"status": "failed", "note": f"{type(error).__name__}: {error}"}
    Path(job["told"]).write_text(json.dumps(told))
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)  # some programs crash when their process ends


if __name__ == "__main__":
    main()
