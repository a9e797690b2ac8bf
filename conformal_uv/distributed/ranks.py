"""The processes that share one surface: sums, exchanges, and errors that all of them raise together."""

from __future__ import annotations

import pickle
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import MissingDependencyError
from ..progress import Callback, Progress

__all__ = ["Ranks", "SharedProgress"]

Array = NDArray[Any]
Ints = NDArray[np.int64]


class Ranks:
    """An MPI communicator and what the algorithms need of it. Every method is collective.

    Parameters
    ----------
    comm : mpi4py.MPI.Intracomm, optional
        By default all processes that mpiexec started.

    Attributes
    ----------
    rank, size : int
    messages, bytes : int
        Sent by this rank to other ranks in exchanges so far; what PETSc sends is not counted.

    Raises
    ------
    MissingDependencyError
        mpi4py is not installed.
    """

    def __init__(self, comm: Any = None) -> None:
        try:
            from mpi4py import MPI
        except ImportError as error:
            raise MissingDependencyError(
                'A surface over several processes needs mpi4py and petsc4py: pip install "conformal-uv[mpi]".'
            ) from error
        self._mpi = MPI
        self.comm = MPI.COMM_WORLD if comm is None else comm
        self.rank, self.size = self.comm.Get_rank(), self.comm.Get_size()
        self.messages = self.bytes = 0

    @contextmanager
    def agreed(self) -> Iterator[None]:
        """Work of each rank by itself; where it fails on any of them, the error of the first such is raised on all.

        The work must hold nothing collective: a rank that failed would keep the others waiting.
        """
        failed: Exception | None = None
        try:
            yield
        except Exception as error:
            failed = error
        if not self.any(failed is not None):
            return
        told = self.comm.allgather(_sendable(failed))
        first = next(error for error in told if error is not None)
        raise first from failed if failed is not None and type(failed) is type(first) else first

    def any(self, flag: bool) -> bool:
        """Whether it is true on a rank."""
        return bool(self.comm.allreduce(int(flag), op=self._mpi.MAX))

    def most(self, value: float) -> float:
        """The largest."""
        return float(self.comm.allreduce(float(value), op=self._mpi.MAX))

    def total(self, values: Array | float) -> Array:
        """The sum over the ranks, entry by entry, with the same bits on all of them."""
        here = np.ascontiguousarray(values)
        there = np.empty_like(here)
        self.comm.Reduce(here, there, op=self._mpi.SUM, root=0)
        return self.same(there)

    def same(self, values: Array) -> Array:
        """The first rank's array, on all of them."""
        self.comm.Bcast(values, root=0)
        return values

    def before(self, count: int) -> int:
        """The sum of the counts of the ranks before this one."""
        return int(self.comm.scan(int(count))) - int(count)

    def each(self, value: Any) -> list[Any]:
        """A small object of each rank."""
        return list(self.comm.allgather(value))

    def joined(self, rows: Array) -> Array:
        """The rows of all ranks, one rank's after the other's; for what is short."""
        rows = np.ascontiguousarray(rows)
        counts = np.array(self.each(len(rows)))
        out = np.empty((int(counts.sum()), *rows.shape[1:]), rows.dtype)
        kind = self._row(rows)
        self.comm.Allgatherv([rows, len(rows), kind], [out, counts, _starts(counts), kind])
        kind.Free()
        return out

    def indices(self, own: Array) -> Ints:
        """Indices that any rank has found, ascending, each once."""
        return np.unique(self.joined(np.asarray(own, dtype=np.int64)))

    def counted(self, to: Ints) -> tuple[Ints, Ints]:
        """How many rows go to each rank, and how many come from each."""
        out = np.bincount(to, minlength=self.size).astype(np.int64)
        back = np.empty_like(out)
        self.comm.Alltoall(out, back)
        return out, back

    def sent(self, rows: Array, out: Ints, back: Ints) -> Array:
        """Rows in the order of the ranks that they go to; those received, in the order of the ranks they come from."""
        rows = np.ascontiguousarray(rows)
        received = np.empty((int(back.sum()), *rows.shape[1:]), rows.dtype)
        kind = self._row(rows)
        self.comm.Alltoallv([rows, out, _starts(out), kind], [received, back, _starts(back), kind])
        kind.Free()
        others = np.delete(out, self.rank)
        self.messages += int(np.count_nonzero(others))
        self.bytes += int(others.sum()) * int(np.prod(rows.shape[1:], dtype=np.int64)) * rows.itemsize
        return received

    def exchanged(self, to: Ints, *columns: Array) -> list[Array]:
        """Each row to the rank named for it; rows come in the order of their ranks, then as they were sent."""
        order = np.argsort(to, kind="stable")
        out, back = self.counted(to)
        return [self.sent(column[order], out, back) for column in columns]

    def _row(self, rows: Array) -> Any:
        """The MPI type of a row: counts of rows may pass 2^31 bytes."""
        size = int(np.prod(rows.shape[1:], dtype=np.int64)) * rows.itemsize
        return self._mpi.BYTE.Create_contiguous(size).Commit()


class SharedProgress(Progress):
    """Progress whose callback runs on every rank; all stop when one of them asks to."""

    def __init__(self, ranks: Ranks, callback: Callback | None) -> None:
        super().__init__(callback)
        self._ranks = ranks
        self._silent = not ranks.any(callback is not None)

    def __call__(self, stage: str, fraction: float) -> None:
        """See Progress."""
        if self._silent:
            return
        with self._ranks.agreed():
            super().__call__(stage, fraction)


def _starts(counts: Ints) -> Ints:
    return np.concatenate(([0], np.cumsum(counts)[:-1]))


def _sendable(error: Exception | None) -> Exception | None:
    try:
        pickle.loads(pickle.dumps(error))
    except Exception:
        return RuntimeError(f"{type(error).__name__}: {error}")
    return error
