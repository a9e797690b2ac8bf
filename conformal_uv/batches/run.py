"""A batch: many mesh files mapped, a row for each as it is done, and what is done kept for the next run."""

from __future__ import annotations

import importlib.util
import logging
import os
from collections.abc import Callable, Generator, Iterable, Sequence
from pathlib import Path
from typing import Any

from ..errors import MissingDependencyError, OptionError
from .inputs import found_tasks
from .leftovers import clear_leftovers
from .plan import Plan
from .row import BatchRow
from .rows_files import RowLog, read_rows, write_tables
from .task import Task
from .worked import worked

__all__ = ["batch", "batch_tasks", "run_batch"]

log = logging.getLogger(__name__)


def batch(
    inputs: str | os.PathLike[str] | Iterable[str | os.PathLike[str]],
    *,
    out: str | os.PathLike[str],
    map: str = "disk",
    scheduler: Any = None,
    workers: int | None = None,
    **options: Any,
) -> Generator[BatchRow, None, None]:
    """Map many mesh files side by side, by Dask.

    Maps are written into the folder `out` by the workers, each in one step; ``rows.jsonl`` there gets a line for each
    as it is done, ``rows.csv`` (and ``rows.parquet`` where pyarrow is installed) has all of them in the end. Run again,
    it does only what is missing: meshes whose content, options and version of conformal_uv are those of a row are not
    mapped again if their map is still there, nor refused again. What failed otherwise is tried again.

    Arguments are checked at the call; the work begins with the first row that is asked for.

    Parameters
    ----------
    inputs : path or paths
        Mesh files, folders (all meshes in them and below), patterns (``scans/**/*.ply``), and manifests: CSV files with
        a column ``input``, or JSON lists; see docs/scale.md.
    out : path
        Folder for the maps, which lie there as their meshes lie below what these have in common.
    map : {"disk", "free", "rectangle", "sphere"}
    scheduler : str, distributed.Client or cluster, optional
        Where the tasks run: the address of a scheduler (``tcp://...``), a client, or a cluster of dask-jobqueue,
        dask-kubernetes or the like. Its workers need conformal_uv and the same files. By default processes of this
        machine, one thread each, no more at once than there is memory for.
    workers : int, optional
        Processes of this machine, by default one for each processor; 0 maps in this process, without Dask.
    **options
        Of `unwrap`, or of `sphere_map`; `seams` (a file, or "uv"), `corners` (of rectangles), `uv` (of spheres:
        "equirectangular" or "octahedral"), `split`, `format` ("obj", "ply", "npz"; by default as the mesh is). All
        names and numbers: no callbacks.

    Yields
    ------
    BatchRow
        One for each input, in the order in which they end. An error of a mesh stands in its row and ends nothing.

    Raises
    ------
    OptionError
        An option that is not taken; no meshes; two meshes with one place for their maps.
    FileFormatError
        A manifest can not be read, or the folder not be written.
    MissingDependencyError
        dask and distributed are not installed (the extra ``cluster``), or what an option needs.
    ConnectionError
        The scheduler has gone away; what was done is kept.

    Notes
    -----
    The processes of this machine are started anew (``spawn``), and load the script that calls this: put the call under
    ``if __name__ == "__main__":``. A worker that dies is replaced and its mesh tried again; one that three workers die
    of is set aside, with the status "killed".

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import conformal_uv as cuv
    >>> folder = tempfile.mkdtemp()
    >>> text = "v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nv 1 1 1\\nf 1 2 3\\nf 2 4 3\\n"
    >>> for name in "ab":
    ...     written = pathlib.Path(folder, f"{name}.obj").write_text(text)
    >>> rows = list(cuv.batch(f"{folder}/*.obj", out=f"{folder}/maps", map="free", workers=0))
    >>> [str(row.status) for row in rows], [row.kept for row in rows]
    (['done', 'done'], [False, False])
    >>> [row.kept for row in cuv.batch(f"{folder}/*.obj", out=f"{folder}/maps", map="free", workers=0)]
    [True, True]
    """
    plan = Plan.of(map, options)
    return run_batch(batch_tasks(inputs, Path(out), plan), Path(out), scheduler=scheduler, workers=workers)


def batch_tasks(inputs: str | os.PathLike[str] | Iterable[str | os.PathLike[str]], out: Path, plan: Plan) -> list[Task]:
    """The tasks of a batch, with what earlier runs told of them; errors as of `batch`."""
    return found_tasks(inputs, out, plan, read_rows(out))


def run_batch(
    tasks: Sequence[Task],
    out: Path,
    *,
    scheduler: Any = None,
    workers: int | None = None,
    told: Callable[[str], object] = log.info,
) -> Generator[BatchRow, None, None]:
    """The rows of tasks as they are done; `told` is told where Dask's dashboard is. Errors as of `batch`."""
    _check(scheduler, workers)
    rows = _rows_here(tasks) if scheduler is None and workers == 0 else _rows_on_dask(tasks, scheduler, workers, told)
    return _kept_rows(tasks, out, rows)


def _check(scheduler: Any, workers: int | None) -> None:
    if workers is not None and (type(workers) is not int or workers < 0):
        raise OptionError(f"workers is {workers!r}; pass a number of processes, or 0 for none but this.")
    if scheduler is not None and workers is not None:
        raise OptionError("A scheduler has workers of its own; leave out workers.")
    missing = [name for name in ("dask", "distributed") if importlib.util.find_spec(name) is None]
    if missing and workers != 0:
        raise MissingDependencyError(
            f'{" and ".join(missing)} not installed: pip install "conformal-uv[cluster]", or set workers to 0, to map '
            "in this process alone."
        )


def _rows_here(tasks: Sequence[Task]) -> Generator[BatchRow, None, None]:
    """One after the other, in this process."""
    for task in sorted(tasks, key=lambda task: -task.memory):
        yield worked(task)


def _rows_on_dask(
    tasks: Sequence[Task], scheduler: Any, workers: int | None, told: Callable[[str], object]
) -> Generator[BatchRow, None, None]:
    from .cluster import connected
    from .flight import rows_in_flight

    with connected(scheduler, workers) as fleet:
        told(f"Dask's dashboard: {fleet.client.dashboard_link}")
        yield from rows_in_flight(fleet, tasks)


def _kept_rows(
    tasks: Sequence[Task], out: Path, rows: Generator[BatchRow, None, None]
) -> Generator[BatchRow, None, None]:
    """The rows, written down before they are passed on; tables in the end, and after an interruption too."""
    found: dict[str, BatchRow] = {task.target: task.before for task in tasks if task.before is not None}
    lines = RowLog(out)
    clear_leftovers(task.target for task in tasks)
    left = len(tasks)
    try:
        for row in rows:
            if not row.kept:
                lines.add(row)
            found[row.output] = row
            left -= 1
            yield row
    finally:
        rows.close()
        lines.close()
        if left == 0:
            clear_leftovers(task.target for task in tasks)
        write_tables(out, [found[task.target] for task in tasks if task.target in found])
