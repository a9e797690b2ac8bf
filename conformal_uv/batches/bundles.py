"""Small meshes handed to a worker together, so that handing them over takes little beside mapping them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from .task import Task

__all__ = ["bundles"]

# A task costs scheduler, client and worker together as much processor time as a map of 1,500 vertices: 600 meshes of
# 1,000 to 20,000 vertices took 35.5 s on two workers by themselves, 31.3 s in bundles.
VERTICES = 150_000  # as estimated: half a second of work
MOST = 64  # meshes, for files of no size
PARTS = 8  # bundles for each thread, at the least where there are as many meshes


def bundles(tasks: Iterable[Task], threads: int) -> Iterator[list[Task]]:
    """All tasks, the largest first: each large one by itself, small ones together."""
    ordered = sorted(tasks, key=lambda task: -task.memory)
    most = min(VERTICES, sum(task.vertices for task in ordered) // (PARTS * threads))
    few = min(MOST, -(-len(ordered) // (PARTS * threads)))
    bundle: list[Task] = []
    total = 0
    for task in ordered:
        if bundle and (total + task.vertices > most or len(bundle) == few):
            yield bundle
            bundle, total = [], 0
        bundle.append(task)
        total += task.vertices
    if bundle:
        yield bundle
