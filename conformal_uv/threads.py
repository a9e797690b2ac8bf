"""One pool of threads for the whole program: as many as the processors allowed to it, or fewer if the user says so.

numpy lets go of the interpreter while it works on arrays, so that threads over blocks of them run side by side.
"""

from __future__ import annotations

import itertools
import os
import threading
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

import numpy as np

__all__ = ["side_by_side", "thread_count"]

Item = TypeVar("Item")
Result = TypeVar("Result")

FEW = 4  # items, which are done before another thread is awake
ENVIRONMENT_VARIABLE = "OMP_NUM_THREADS"

_lock = threading.Lock()
_pool: ThreadPoolExecutor | None = None
_here = threading.local()


def thread_count() -> int:
    """The processors that this process may use; no more than OMP_NUM_THREADS, where that is a number."""
    asked = os.environ.get(ENVIRONMENT_VARIABLE, "").split(",")[0].strip()
    allowed = _allowed()
    return min(int(asked), allowed) if asked.isdecimal() and int(asked) > 0 else allowed


def side_by_side(work: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """``[work(item) for item in items]``, the items shared out among this thread and others.

    Every item is worked on whole by one thread, so that results do not depend on how many there are. Errors end all
    work, and the first in the order of the items is raised. Work that calls this again stays in its own thread.
    """
    given = list(items)
    helpers = 0 if len(given) < FEW or getattr(_here, "busy", False) else min(thread_count(), len(given) // 2) - 1
    if helpers < 1:
        return [work(item) for item in given]
    shared = _Shared(work, given)
    waiting = []
    try:
        pool = _shared_pool()
        waiting = [pool.submit(shared.take) for _ in range(helpers)]
    except RuntimeError:  # the interpreter is about to end, and starts no threads any more
        pass
    try:
        shared.take()
    finally:  # Ctrl+C as well: nobody goes on in arrays that the caller gives up
        shared.ended = True
        for future in waiting:
            if not future.cancel():
                future.exception()
    if shared.errors:
        raise shared.errors[min(shared.errors)]
    return shared.results


class _Shared:
    """Items in work, which threads take one after the other."""

    def __init__(self, work: Callable[[Any], Any], items: list[Any]) -> None:
        self.results: list[Any] = [None] * len(items)
        self.errors: dict[int, BaseException] = {}
        self.ended = False
        self._work, self._items, self._turn = work, items, itertools.count()
        self._floating: dict[str, Any] = dict(np.geterr())  # is told to every thread by itself

    def take(self) -> None:
        """Work on what is left."""
        _here.busy = True
        try:
            with np.errstate(**self._floating):
                while not self.ended and (k := next(self._turn)) < len(self._items):
                    try:
                        self.results[k] = self._work(self._items[k])
                    except BaseException as error:  # raised where the work was asked for
                        self.errors[k], self.ended = error, True
        finally:
            _here.busy = False


def _allowed() -> int:
    if hasattr(os, "process_cpu_count"):  # Python 3.13
        return os.process_cpu_count() or 1
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0)) or 1
    return os.cpu_count() or 1


def _shared_pool() -> ThreadPoolExecutor:
    global _pool
    with _lock:
        if _pool is None:
            _pool = ThreadPoolExecutor(_allowed(), thread_name_prefix="conformal-uv")
        return _pool


def _forget_pool() -> None:
    """A forked child has none of its parent's threads, and may have got the lock while one of them held it."""
    global _pool, _lock
    _pool, _lock = None, threading.Lock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget_pool)
