"""conformal-uv disk --backend petsc: one surface over the processes of an MPI job."""

from __future__ import annotations

import json
import sys
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import typer

from .._version import __version__
from ..console.stages import Stages
from ..console.summary import angles_text, print_rows
from ..console.terminal import plain
from ..distributed import DistributedDiskMap, distributed_disk_map, read_slice, write_slices
from ..distributed.ranks import Ranks
from ..errors import ConformalUVError, OptionError, Remedy
from ..files import check_distinct, check_place, replaced_file

__all__ = ["map_giant"]

MOST_LISTED = 1000  # folded faces written to JSON


def map_giant(
    source: Path, target: Path, json_file: Path | None, quiet: bool, unused: dict[str, bool], **options: Any
) -> None:
    """Read, map and write, every process its rows.

    `unused` tells of options that only one process has whether they were given.

    Raises
    ------
    typer.Exit
        With code 1, on all processes, the first of which has told why.
    """
    ranks = Ranks()

    def work() -> None:
        with ranks.agreed():
            _check(source, target, json_file, unused)
        stages = Stages(quiet=quiet or ranks.rank > 0)
        with stages:
            stages("read", 0.0)
            V, F = read_slice(source, ranks.comm)
            found = distributed_disk_map(V, F, comm=ranks.comm, callback=stages, **options)
            stages("write", 0.0)
            write_slices(target, ranks.comm, V=V.astype(np.float64), F=F.astype(np.int64), uv=0.5 + 0.5 * found.uv)
            summary = _summary(found, source, target)
        summary["seconds"] = stages.seconds
        with ranks.agreed():
            if ranks.rank == 0 and json_file is not None:
                with replaced_file(json_file) as out:
                    out.write((json.dumps(summary, indent=2) + "\n").encode())
        if ranks.rank == 0 and not quiet:
            print_rows(_rows(summary))

    _together(ranks, work)


def _together(ranks: Ranks, work: Callable[[], None]) -> None:
    """Errors of ours are those of all processes, and told once; any other one ends the job."""
    try:
        work()
    except ConformalUVError as error:
        if ranks.rank == 0:
            message = " ".join(error.told(Remedy.as_flag).split())
            typer.echo(plain(f"{type(error).__name__}: {message}"), err=True)
            sys.stderr.flush()
        ranks.comm.Barrier()
        time.sleep(0.1 * (ranks.rank > 0))  # mpiexec ends the job with the first of them: the one that has told
        raise typer.Exit(1) from error
    except Exception:
        traceback.print_exc()
        sys.stderr.flush()
        ranks.comm.Abort(1)


def _check(source: Path, target: Path, json_file: Path | None, unused: dict[str, bool]) -> None:
    given = [name for name, was_given in unused.items() if was_given]
    if given:
        raise OptionError(f"--backend petsc does without {', '.join(given)}; leave that out.")
    if target.suffix.lower() != ".npz":
        raise OptionError(f"--backend petsc writes NPZ archives, not {target.name}; choose a name that ends in .npz.")
    check_distinct(None if source.is_dir() else source, {"OUT": target, "--json": json_file})
    check_place(target)
    if json_file is not None:
        check_place(json_file)


def _summary(found: DistributedDiskMap, source: Path, target: Path) -> dict[str, Any]:
    numbers = found.numbers
    return {
        "conformal_uv": __version__,
        "input": str(source),
        "output": str(target),
        "processes": found.ranks.size,
        "mesh": {
            "triangles": found.faces,
            "vertices": found.vertices,
            "boundary_vertices": len(found.boundary),
        },
        "method": found.method,
        "objective": found.objective,
        "map_status": found.status,
        "converged": found.converged,
        "center": found.center,
        "pins": list(found.pins) if found.pins is not None else None,
        "laplacian": "cotan",
        "negative_edges": found.negative_edges,
        "backend": "petsc",
        "solver": found.solver,
        "solver_steps": list(found.steps),
        "history": [dict(zip(row._fields, row, strict=True)) for row in found.history],
        "sent": [{"messages": messages, "bytes": size} for messages, size in found.sent],
        "conformal_energy": numbers.conformal_energy,
        "dirichlet_energy": numbers.dirichlet_energy,
        "angle_error_degrees": {
            "mean": numbers.angle_mean,
            "rms": numbers.angle_rms,
            "sd": numbers.angle_sd,
            "max": numbers.angle_max,
        },
        "quasi_conformal_ratio": {
            "max": numbers.quasi_conformal_max if np.isfinite(numbers.quasi_conformal_max) else None
        },
        "area_ratio": numbers.area_ratio,
        "flipped_faces": len(found.flipped),
        "flipped": found.flipped[:MOST_LISTED].tolist(),
        "lost_to_double": numbers.lost_to_double,
    }


def _rows(summary: dict[str, Any]) -> list[tuple[str, str]]:
    mesh = summary["mesh"]
    steps = summary["solver_steps"]
    return [
        ("mesh", "{vertices} vertices, {triangles} triangles, {boundary_vertices} on the boundary".format(**mesh)),
        ("processes", f"{summary['processes']}"),
        ("method", "{method}, {objective} energy, cotan Laplacian, PETSc's {solver}".format(**summary)),
        ("solutions", f"{len(steps)}, of {max(steps, default=0)} steps at most"),
        ("angle error", angles_text(summary["angle_error_degrees"])),
        ("flipped faces", f"{summary['flipped_faces']}, {summary['negative_edges']} edges of negative weight"),
        ("seconds", ", ".join(f"{stage} {seconds:.2f}" for stage, seconds in summary["seconds"].items())),
    ]
