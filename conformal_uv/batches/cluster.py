"""Where the tasks of a batch run: processes of this machine, or the workers of a scheduler. Needs dask.distributed."""

from __future__ import annotations

import logging
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import dask
from dask.system import CPU_COUNT
from distributed import Client, LocalCluster, Worker
from distributed.diagnostics.plugin import WorkerPlugin

from ..errors import OptionError
from ..linear.memory import memory_at_hand

__all__ = ["Fleet", "connected"]

PART = 0.9  # of the memory at hand, for all meshes in work together
LOOK = 2.0  # seconds, after which the workers are counted again
# A worker that dies is blamed on every task that waits there, so that the first death says little; see `flight`.
# While CHOLMOD holds the interpreter a worker does not answer, for minutes on the largest meshes.
# Dask's own environment has MALLOC_TRIM_THRESHOLD_, with which arrays go back to the system at once: 8.8 instead of 5.1
# processor seconds for 60 meshes, and no less memory at the peak. Samples of the stack and clocks cost some more.
SETTINGS = {
    "distributed.scheduler.allowed-failures": 0,
    "distributed.scheduler.worker-ttl": None,
    "distributed.worker.profile.enabled": False,
    "distributed.admin.tick.interval": "500ms",
    "distributed.nanny.pre-spawn-environ": {
        "OMP_NUM_THREADS": 1,
        "MKL_NUM_THREADS": 1,
        "OPENBLAS_NUM_THREADS": 1,
    },
}


class Fleet:
    """The workers of a scheduler: how many tasks they take at once, and with how much memory.

    Attributes
    ----------
    client : distributed.Client
    threads : int
        Tasks that run at once, all workers together; at least one.
    memory : int or None
        Bytes for all tasks together; None where nobody has set a limit.
    """

    def __init__(self, client: Client, memory: int | None = None) -> None:
        self.client, self.threads, self.memory = client, 1, memory
        self._whole = memory
        self._limits: dict[str, int] = {}
        self._looked = -LOOK

    def look(self) -> None:
        """Count the workers, which come and go."""
        now = time.monotonic()
        if now - self._looked < LOOK:
            return
        self._looked = now
        workers = self.client.scheduler_info(n_workers=-1)["workers"]
        self.threads = max(1, sum(worker["nthreads"] for worker in workers.values()))
        self._limits = {address: worker["memory_limit"] or 0 for address, worker in workers.items()}
        if self._whole is None:
            limited = bool(self._limits) and all(self._limits.values())
            self.memory = int(PART * sum(self._limits.values())) if limited else None

    def large_enough(self, memory: int) -> list[str] | None:
        """Addresses of the workers with so much memory, where some have it and some not."""
        found = [address for address, limit in self._limits.items() if not limit or limit >= memory]
        return found if 0 < len(found) < len(self._limits) else None


@contextmanager
def connected(scheduler: Any, workers: int | None) -> Iterator[Fleet]:
    """The fleet of a scheduler, or one of this machine's processes for as long as the block runs.

    Parameters
    ----------
    scheduler : str, Client or cluster, optional
        An address, or an object of distributed, dask-jobqueue or dask-kubernetes, which is left as it is.
    workers : int, optional
        Processes of this machine, by default one for each processor.

    Raises
    ------
    OptionError
        It is none of these, or no scheduler answers there.
    """
    if scheduler is None:
        with _local(workers or CPU_COUNT) as fleet:
            yield fleet
        return
    with _silent("distributed.client"):
        yield from _elsewhere(scheduler)


def _elsewhere(scheduler: Any) -> Iterator[Fleet]:
    """The fleet of an address or an object."""
    if isinstance(scheduler, Client):
        yield Fleet(scheduler)
        return
    if not isinstance(scheduler, str) and not hasattr(scheduler, "scheduler_address"):
        raise OptionError(f"scheduler is {scheduler!r}; pass an address (tcp://...), a Client or a cluster of Dask's.")
    try:
        client = Client(scheduler)
    except (OSError, ValueError) as error:
        raise OptionError(
            f"No scheduler of Dask's answers at {scheduler} ({error}); start one, or leave it out."
        ) from (error)
    with client:
        yield Fleet(client)


@contextmanager
def _local(workers: int) -> Iterator[Fleet]:
    """So many processes with a thread each, none of which may take more memory than the machine has."""
    memory = memory_at_hand()
    with (
        dask.config.set(SETTINGS),
        LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            memory_limit=memory or 0,
            dashboard_address="127.0.0.1:0",
            silence_logs=logging.CRITICAL,
        ) as cluster,
        Client(cluster) as client,
    ):
        client.register_plugin(_Uninterrupted(), name="conformal-uv-uninterrupted")
        yield Fleet(client, int(PART * memory) if memory else None)


@contextmanager
def _silent(name: str) -> Iterator[None]:
    """Without the messages of a logger; a scheduler that goes away is told of by the error."""
    logger = logging.getLogger(name)
    level = logger.level
    logger.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        logger.setLevel(level)


class _Uninterrupted(WorkerPlugin):
    """Ctrl-C at a terminal goes to all its processes; the one that started the others ends them."""

    def setup(self, worker: Worker) -> None:
        if threading.current_thread() is threading.main_thread():
            signal.signal(signal.SIGINT, signal.SIG_IGN)
