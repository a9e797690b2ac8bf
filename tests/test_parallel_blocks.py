"""Blocks shared out among threads: the same results with any number of them, errors, nesting, forks."""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from conformal_uv import threads
from conformal_uv.mesh.blocks import BLOCK, blocks, by_blocks
from conformal_uv.threads import side_by_side, thread_count

RESULTS = """
import hashlib, numpy as np, conformal_uv as cuv
from conformal_uv.samples import terrain
V, F = terrain(40_000, seed=1)
V = V + 0.002 * np.random.default_rng(2).standard_normal(V.shape)
m = cuv.disk_map(V, F, method="linear", backend="superlu")
d = m.distortion
told = [m.uv, m.flipped, d.angle_error, d.quasi_conformal, d.area_scale, np.array([m.conformal_energy, d.angle_mean])]
print(m.laplacian, m.repair, hashlib.sha256(b"".join(np.ascontiguousarray(x).tobytes() for x in told)).hexdigest())
"""


@pytest.fixture
def two_processors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(threads, "_allowed", lambda: 2)
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    monkeypatch.setattr(threads, "_pool", None)


def told(count: str) -> str:
    """What a map comes to in a process with so many threads."""
    code = "import conformal_uv.threads as t; t._allowed = lambda: 4\n" + RESULTS
    found = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "OMP_NUM_THREADS": count},
        cwd=Path(__file__).parents[1],
        capture_output=True,
        text=True,
        check=True,
    )
    return found.stdout


def test_results_are_the_same_bits_with_any_number_of_threads() -> None:
    one = told("1")
    assert one.startswith("intrinsic-delaunay Repair")
    assert told("2") == one
    assert told("4") == one


@pytest.mark.parametrize(
    ("asked", "allowed", "expected"),
    [("", 3, 3), ("2", 3, 2), ("8", 3, 3), ("2,4", 3, 2), ("0", 3, 3), ("-1", 3, 3), ("many", 3, 3), (" 1 ", 3, 1)],
)
def test_threads_are_no_more_than_processors_and_than_asked_for(
    asked: str, allowed: int, expected: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OMP_NUM_THREADS", asked)
    monkeypatch.setattr(threads, "_allowed", lambda: allowed)
    assert thread_count() == expected


def test_processors_allowed_are_those_of_this_process() -> None:
    if hasattr(os, "sched_getaffinity"):
        assert threads._allowed() <= len(os.sched_getaffinity(0))
    assert 1 <= threads._allowed() <= (os.cpu_count() or 1)


def test_few_blocks_or_one_thread_starts_no_pool(two_processors: None, monkeypatch: pytest.MonkeyPatch) -> None:
    assert by_blocks(lambda part: part.stop, 3 * BLOCK) == [BLOCK, 2 * BLOCK, 3 * BLOCK]
    monkeypatch.setenv("OMP_NUM_THREADS", "1")
    assert by_blocks(lambda part: part.start, 5 * BLOCK) == [k * BLOCK for k in range(5)]
    assert threads._pool is None


def test_results_come_in_the_order_of_the_items_from_several_threads(two_processors: None) -> None:
    names = set()

    def work(item: int) -> int:
        names.add(threading.current_thread().name)
        time.sleep(0.02)
        return item * item

    assert side_by_side(work, range(20)) == [k * k for k in range(20)]
    assert len(names) == 2


def test_blocks_cover_all_of_an_array() -> None:
    parts = list(blocks(2 * BLOCK + 5))
    assert [p.start for p in parts] == [0, BLOCK, 2 * BLOCK] and parts[-1].stop == 2 * BLOCK + 5
    assert by_blocks(lambda part: part, 0) == []


@pytest.mark.parametrize("kind", [ValueError, KeyboardInterrupt])
def test_the_first_error_is_raised_when_no_other_work_goes_on(kind: type[BaseException], two_processors: None) -> None:
    running = []

    def work(item: int) -> None:
        running.append(item)
        time.sleep(0.01)
        if item in (2, 3):
            raise kind(str(item))
        running.remove(item)

    with pytest.raises(kind, match="2"):
        side_by_side(work, range(100))
    left = list(running)
    assert set(left) <= {2, 3}  # nobody else is at work any more
    time.sleep(0.05)
    assert running == left
    assert side_by_side(str, range(8)) == list("01234567")


def test_work_inside_of_work_stays_in_its_thread(two_processors: None) -> None:
    def outer(item: int) -> set[str]:
        return set(side_by_side(lambda _: threading.current_thread().name, range(4)))

    assert all(len(names) == 1 for names in side_by_side(outer, range(6)))


def test_the_callers_ways_with_overflow_hold_in_every_thread(two_processors: None) -> None:
    big = np.full(4, 1e300)
    with np.errstate(over="ignore"):
        side_by_side(lambda _: (time.sleep(0.01), big * big), range(8))
    with np.errstate(over="raise"), pytest.raises(FloatingPointError):
        side_by_side(lambda _: big * big, range(8))


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_forked_child_makes_its_own_threads(two_processors: None) -> None:
    assert side_by_side(str, range(8)) == list("01234567")
    context = multiprocessing.get_context("fork")
    child = context.Process(target=lambda: os._exit(side_by_side(str, range(8)) != list("01234567")))
    child.start()
    child.join(30)
    assert child.exitcode == 0


def test_an_interpreter_that_ends_works_in_one_thread(two_processors: None, monkeypatch: pytest.MonkeyPatch) -> None:
    class Ended:
        def submit(self, *args: object) -> None:
            raise RuntimeError("cannot schedule new futures after interpreter shutdown")

    monkeypatch.setattr(threads, "_pool", Ended())
    assert side_by_side(str, range(8)) == list("01234567")
