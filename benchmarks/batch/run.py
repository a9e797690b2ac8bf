"""One run over a cohort, for ``python -m benchmarks.batch``: ``... run MESHES OUT WORKERS MAP [--kill]``."""

from __future__ import annotations

import json
import os
import random
import resource
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import psutil

import conformal_uv as cuv

__all__ = ["main"]

EVERY = 0.05  # seconds between two looks at the memory


class Watched:
    """The memory of this process and its children while a block runs, and the most that all had together."""

    def __init__(self) -> None:
        self.most, self._ended = 0, threading.Event()
        self._thread = threading.Thread(target=self._look, daemon=True)

    def _look(self) -> None:
        me = psutil.Process()
        while not self._ended.wait(EVERY):
            total = 0
            for process in [me, *me.children(recursive=True)]:
                try:
                    total += process.memory_info().rss
                except psutil.Error:
                    continue
            self.most = max(self.most, total)

    def __enter__(self) -> Watched:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self._thread.join()


def main(arguments: list[str]) -> None:
    """Map and tell."""
    meshes, out, workers, kind, *more = arguments
    began = time.perf_counter()
    first = 0.0
    rows: list[cuv.BatchRow] = []

    def batch() -> Iterator[cuv.BatchRow]:
        return cuv.batch(meshes, out=out, map=kind, workers=int(workers))

    with Watched() as watched:
        for row in _disturbed(batch) if "--kill" in more else batch():
            first = first or time.perf_counter()
            rows.append(row)
    done = time.perf_counter()
    told = {
        "seconds": done - began,
        "seconds_after_first": done - first,
        "meshes_after_first": len(rows) - 1,
        "rows": len(rows),
        "processor_seconds": _processor_seconds(),
        "largest_process": max(row.peak_memory or 0 for row in rows),
        "together": watched.most,
        "kept": sum(row.kept for row in rows),
        "lines": len((Path(out) / "rows.jsonl").read_text().splitlines()),
    }
    print(json.dumps(told))


def _disturbed(batch: Callable[[], Iterator[cuv.BatchRow]]) -> Iterator[cuv.BatchRow]:
    """The rows of a batch, one of whose workers is killed, which then is interrupted and begun again."""
    count = sum(1 for _ in Path(sys.argv[1]).iterdir())
    rows = batch()
    for number, _ in enumerate(rows, 1):
        if number == count // 3:
            os.kill(random.Random(0).choice(_workers()), signal.SIGKILL)
        if number == 2 * count // 3:
            rows.close()  # type: ignore[attr-defined]
            break
    yield from batch()


def _processor_seconds() -> float:
    """Of this process and of all that it has started, which have ended."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)


def _workers() -> list[int]:
    """Processes that map, told by what they have been started with."""
    children = psutil.Process().children(recursive=True)
    return sorted(child.pid for child in children if "spawn_main" in " ".join(child.cmdline()))


if __name__ == "__main__":
    main(sys.argv[1:])
