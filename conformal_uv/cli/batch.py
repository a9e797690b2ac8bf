"""conformal-uv batch: many meshes mapped side by side, on this machine or on a cluster."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Annotated, Any

import typer

from ..batches import BatchRow, Outcome, Plan, batch_tasks, run_batch
from ..console.stages import Stages
from ..console.summary import print_rows
from ..console.terminal import plain
from ..options import MapKind
from .arguments import Quiet
from .batch_page import write_page
from .map_options import given_options, with_map_options

__all__ = ["batch"]

MOST_LISTED = 20  # meshes that were not mapped
MEANING = {
    Outcome.DONE: "mapped",
    Outcome.PARTIAL: "mapped but for some charts",
    Outcome.REFUSED: "can not be mapped",
    Outcome.FAILED: "failed",
    Outcome.KILLED: "set aside, for workers died of them",
}


@with_map_options
def batch(
    inputs: Annotated[
        list[str],
        typer.Argument(metavar="INPUTS...", help="Meshes, folders, patterns in quotes, manifests (CSV, JSON)."),
    ],
    out: Annotated[Path, typer.Option(metavar="FOLDER", help="Folder for the maps, rows.* and summary.html.")],
    map: Annotated[MapKind, typer.Option(help="What surfaces become.")] = MapKind.DISK,
    workers: Annotated[
        int | None,
        typer.Option(min=0, metavar="N", help="Processes of this machine, by default all processors; 0: only this."),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="tcp://...", help="Address of a scheduler of Dask's, whose workers do the work."),
    ] = None,
    format: Annotated[
        str | None, typer.Option(metavar="obj|ply|npz", help="Of the maps; by default as of the meshes.")
    ] = None,
    quiet: Quiet = False,
    **values: Any,
) -> None:
    """Map many meshes side by side; run again, do only what is missing.

    FOLDER gets the maps, rows.jsonl (a line for each mesh as it is done), rows.csv and summary.html. The options are
    those of the commands disk, free, rectangle and sphere. The exit code is 1 if a mesh was not mapped.
    """
    plan = Plan.of(map, {**given_options(map, values), "format": format}, flags=True)
    tasks = batch_tasks(inputs, out, plan)

    def told(text: str) -> None:
        if not quiet:
            typer.echo(plain(text), err=True)

    rows: list[BatchRow] = []
    with Stages(quiet=quiet) as stages:
        stages("workers", 0.0)
        with closing(run_batch(tasks, out, scheduler=scheduler, workers=workers, told=told)) as found:
            rows.extend(_counted(found, len(tasks), stages))
        stages("summary", 0.0)
        page = write_page(out, rows)
    if not quiet:
        _print(rows, page)
    if not all(row.ok for row in rows):
        raise typer.Exit(1)


def _counted(rows: Iterator[BatchRow], count: int, stages: Stages) -> Iterator[BatchRow]:
    """The rows, the bar going on with each."""
    failed = 0
    for number, row in enumerate(rows, 1):
        failed += not row.ok
        stages(f"{number}/{count}" + (f", {failed} bad" if failed else ""), number / count)
        yield row


def _print(rows: list[BatchRow], page: Path) -> None:
    counts = Counter(row.status for row in rows)
    kept = sum(row.kept for row in rows)
    told = [("meshes", f"{len(rows)}" + (f", {kept} of them in earlier runs" if kept else ""))]
    told += [(str(status), f"{counts[status]} {MEANING[status]}") for status in Outcome if counts[status]]
    bad = [row for row in rows if not row.ok]
    told += [("", f"{row.input}: {row.error}: {row.message}") for row in bad[:MOST_LISTED]]
    told += [("", f"and {len(bad) - MOST_LISTED} more, in rows.csv")] if len(bad) > MOST_LISTED else []
    print_rows([*told, ("summary", str(page))])
