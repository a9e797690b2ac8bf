"""What takes minutes: memory over 20,000 maps, and maps in four threads against the same ones in a row.

``python tests/long_run.py`` says what it measured and ends with 1 where something does not hold. Linux only.
"""

from __future__ import annotations

import argparse
import sys
import threading
from collections.abc import Callable
from pathlib import Path

import numpy as np
from meshes_closed import icosphere

import conformal_uv as cuv
from conformal_uv.samples import flat_disk, mask

MOST_GROWTH = 2_000_000  # bytes, after the first maps


def resident() -> int:
    """Bytes of memory in use."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096


def growth(maps: int, vertices: int = 200, warm: int = 1000) -> int:
    """Bytes that maps of one small mesh after the first `warm` leave behind."""
    V, F = mask(vertices)
    for _ in range(warm):
        cuv.disk_map(V, F)
    before = resident()
    for _ in range(maps - warm):
        cuv.disk_map(V, F)
    return resident() - before


def jobs(count: int, most: int) -> list[Callable[[], np.ndarray]]:
    """Maps of all kinds over meshes of 100 to `most` vertices."""
    sizes = np.geomspace(100, most, 8).astype(int).tolist()
    disks = [mask(n) for n in sizes[::2]] + [flat_disk(n) for n in sizes[1::2]]
    balls = [icosphere(2), icosphere(3)]
    kinds: list[Callable[[], np.ndarray]] = []
    for V, F in disks:
        kinds += [
            lambda V=V, F=F: cuv.disk_map(V, F).uv,
            lambda V=V, F=F: cuv.disk_map(V, F, method="linear").uv,
            lambda V=V, F=F: cuv.unwrap(V, F, method="linear").uv,
        ]
    for V, F in balls:
        kinds.append(lambda V=V * [1.0, 1.2, 1.5], F=F: cuv.sphere_map(V, F).xyz)
    return [kinds[k % len(kinds)] for k in range(count)]


def differing(threads: int, maps: int, most: int) -> list[str]:
    """What went wrong when each thread made so many maps, switching as often as Python can."""
    work = jobs(64, most)
    expected = [job() for job in work]
    wrong: list[str] = []

    def run(seed: int) -> None:
        for k in np.random.default_rng(seed).integers(len(work), size=maps).tolist():
            try:
                if not np.array_equal(work[k](), expected[k]):
                    wrong.append(f"map {k} differs")
            except Exception as error:  # noqa: BLE001 - whatever it is, it is what is looked for
                wrong.append(f"map {k}: {type(error).__name__}: {error}")

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        pool = [threading.Thread(target=run, args=(seed,)) for seed in range(threads)]
        for thread in pool:
            thread.start()
        for thread in pool:
            thread.join()
    finally:
        sys.setswitchinterval(interval)
    return wrong


def main() -> int:
    """Run both at full length."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--maps", type=int, default=20_000)
    options.add_argument("--threaded", type=int, default=250, help="maps in each of four threads")
    asked = options.parse_args()
    grown = growth(asked.maps)
    wrong = differing(4, asked.threaded, 10_000)
    print(f"{asked.maps} maps of 200 vertices: {grown} bytes more after the first 1,000")
    print(f"4 threads x {asked.threaded} maps: {len(wrong)} wrong {wrong[:3]}")
    return int(grown > MOST_GROWTH or bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
