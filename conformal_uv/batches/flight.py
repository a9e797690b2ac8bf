"""The tasks of a batch on Dask: as many at once as there are processors and memory, their rows as they come.

A scheduler tells of each task on a worker that died that it may be the cause, those that only waited there included.
Such a task is suspected, each mesh of it by itself, and run again when all others are done and nothing else is in work,
so that it alone is to blame if the next worker dies too. After three deaths it is set aside.
"""

from __future__ import annotations

import uuid
from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from distributed import Future, as_completed
from distributed.scheduler import KilledWorker

from .._version import __version__
from ..errors import MissingDependencyError
from .bundles import bundles
from .cluster import Fleet
from .row import BatchRow, Outcome
from .task import Task
from .worked import worked_together

__all__ = ["rows_in_flight"]

DEATHS = 3  # of workers, after which a task is set aside
GONE = "The scheduler or its connection has gone away; what is done is kept, and the same run again goes on."
AHEAD = 2  # tasks for each thread: one in work and one that waits beside it


@dataclass
class _Flown:
    tasks: list[Task]
    alone: bool
    deaths: int = 0

    @property
    def memory(self) -> int:
        """Of the largest, for they are done one after the other."""
        return max(task.memory for task in self.tasks)

    def apart(self, alone: bool, deaths: int) -> list[_Flown]:
        """Each mesh by itself."""
        return [_Flown([task], alone, deaths) for task in self.tasks]


def rows_in_flight(fleet: Fleet, tasks: Iterable[Task]) -> Iterator[BatchRow]:
    """The rows of all tasks, each once, in the order in which they end; the largest meshes are begun first.

    Raises
    ------
    MissingDependencyError
        The workers do not have this package.
    ConnectionError
        The scheduler has gone away.
    """
    fleet.look()
    waiting = deque(_Flown(bundle, False) for bundle in bundles(tasks, fleet.threads))
    suspects: deque[_Flown] = deque()
    flight = _Flight(fleet)
    try:
        while waiting or suspects or flight:
            fleet.look()
            while waiting and flight.admits(waiting[0]):
                flight.start(waiting.popleft())
            if suspects and not flight:
                flight.start(suspects.popleft())
            rows, again = flight.landed()
            yield from rows
            for flown in again:
                (suspects if flown.alone else waiting).append(flown)
    finally:
        flight.cancel()


class _Flight:
    """What is in work."""

    def __init__(self, fleet: Fleet) -> None:
        self._fleet, self._memory = fleet, 0
        self._flown: dict[Future, _Flown] = {}
        self._completed = as_completed(loop=fleet.client.loop)
        self._name = f"conformal-uv-{uuid.uuid4().hex}"
        self._count = 0

    def __bool__(self) -> bool:
        return bool(self._flown)

    def admits(self, flown: _Flown) -> bool:
        """Whether there is a processor and memory for one more; a mesh larger than all memory is tried alone."""
        if not self._flown:
            return True
        whole = self._fleet.memory
        fits = whole is None or self._memory + flown.memory <= whole
        return fits and len(self._flown) < AHEAD * self._fleet.threads

    def start(self, flown: _Flown) -> None:
        """Hand it to the scheduler."""
        self._count += 1
        workers = self._fleet.large_enough(flown.memory)
        future = self._fleet.client.submit(
            worked_together,
            flown.tasks,
            key=f"{self._name}-{self._count}",
            pure=False,
            workers=workers,
            allow_other_workers=workers is not None,
        )
        self._flown[future] = flown
        self._memory += flown.memory
        self._completed.add(future)

    def landed(self) -> tuple[list[BatchRow], list[_Flown]]:
        """The rows of the next that ends, or what of it is to be run again."""
        future = next(self._completed)
        flown = self._flown.pop(future)
        self._memory -= flown.memory
        if future.status in ("cancelled", "lost"):
            raise ConnectionError(GONE)
        try:
            return future.result(), []
        except KilledWorker as error:
            return self._died(flown, error)
        except OSError as error:  # of the connection: a task tells of its own in its row
            raise ConnectionError(GONE) from error
        except ImportError as error:
            raise _missing(error) from error
        except Exception as error:
            if isinstance(error.__cause__, ImportError):
                raise _missing(error.__cause__) from error
            if len(flown.tasks) > 1:
                return [], flown.apart(False, flown.deaths)
            return [_row(flown.tasks[0], Outcome.FAILED, type(error).__name__, str(error))], []

    def _died(self, flown: _Flown, error: KilledWorker) -> tuple[list[BatchRow], list[_Flown]]:
        deaths = flown.deaths + error.allowed_failures + 1
        if flown.alone and deaths >= DEATHS:
            told = (
                f"{deaths} workers died while they had this mesh, the last with nothing else in work; it is set aside"
            )
            return [_row(task, Outcome.KILLED, "KilledWorker", told) for task in flown.tasks], []
        return [], flown.apart(True, deaths)

    def cancel(self) -> None:
        """Give up what has not ended."""
        if self._flown and self._fleet.client.status == "running":
            self._fleet.client.cancel(list(self._flown))


def _missing(error: ImportError) -> MissingDependencyError:
    return MissingDependencyError(
        f"The scheduler or its workers can not load conformal_uv ({error}); install it there."
    )


def _row(task: Task, status: Outcome, error: str, message: str) -> BatchRow:
    return BatchRow(
        input=task.source,
        output=task.target,
        status=status,
        map=str(task.plan.kind),
        error=error,
        message=message,
        options=task.plan.options,
        version=__version__,
    )
