"""What a worker does: one mesh file read, mapped and written, and a row of what came of it."""

from __future__ import annotations

import hashlib
import logging
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from .._version import __version__
from ..errors import (
    ConformalUVError,
    FileFormatError,
    MeshError,
    MissingDependencyError,
    OptionError,
    Remedy,
    SolverError,
)
from ..files import MeshFile, read_mesh, write_mesh
from ..options import MapKind, SphereLayout
from .numbers import sphere_fields, unwrapped_fields
from .row import BatchRow, Outcome
from .sphere_file import sphere_file, stored_sphere
from .task import Task
from .unwrapped_file import stored_uv, unwrapped_file

__all__ = ["worked", "worked_together"]

LOG = logging.getLogger(__name__.rsplit(".", 2)[0])  # of the whole package, whatever it is called where it is carried
LASTING = (MeshError, FileFormatError, OptionError)  # of reading and mapping, which depend on the input alone
PASSING = (SolverError, MissingDependencyError)
PIECE = 1 << 22


def worked_together(tasks: Sequence[Task]) -> list[BatchRow]:
    """The same for several, one after the other."""
    return [worked(task) for task in tasks]


def worked(task: Task) -> BatchRow:
    """Map one file; an error of it is told in the row, and raised by nobody.

    What an earlier run has done is not done again if the input, the options, the version and the output are those of
    that run.
    """
    began = time.perf_counter()
    told: dict[str, Any] = {"options": task.plan.options, "version": __version__, "map": str(task.plan.kind)}
    stage = "read"
    with _warnings() as warned:
        try:
            told["input_hash"] = _input_hash(task)
            if _stands(task, told):
                assert task.before is not None
                return replace(task.before, kept=True)
            mesh_file = read_mesh(task.source)
            stage = "map"
            fields, image, corner_uv, partial = _mapped(task, mesh_file)
            told |= fields
            stage = "write"
            _write(task, image, corner_uv)
            told["output_hash"] = _hash(task.target)
            told |= {"status": Outcome.DONE, **partial}
        except Exception as error:  # of whatever kind: one mesh does not end a batch
            # The base class itself says that the charts of a mesh have each an error of their own.
            lasts = stage != "write" and (isinstance(error, LASTING) or type(error) is ConformalUVError)
            status = Outcome.REFUSED if lasts else Outcome.FAILED
            told |= {"status": status, "error": type(error).__name__, "message": _text(task, error)}
    told |= {"warnings": "; ".join(warned) or None, "seconds": time.perf_counter() - began, "peak_memory": _peak()}
    return BatchRow(input=task.source, output=task.target, **told)


def _mapped(task: Task, mesh_file: MeshFile) -> tuple[dict[str, Any], MeshFile, Any, dict[str, Any]]:
    """Fields of the row, what is written, its texture coordinates, and what is told where charts are missing."""
    given = task.plan.given
    for name in ("split", "format"):
        given.pop(name, None)
    if task.plan.kind is MapKind.SPHERE:
        layout = SphereLayout.of("uv", given.pop("uv", SphereLayout.NONE))
        sphere = sphere_file(mesh_file.mesh, **given)
        return sphere_fields(sphere), *stored_sphere(sphere, mesh_file.mesh, layout, Path(task.target)), {}
    words = Remedy.as_flag if task.plan.flags else None
    result = unwrapped_file(mesh_file, words=words, shape=str(task.plan.kind), **given)
    partial = {}
    if not result.mapped[result.chart_of_face >= 0].all():
        errors = list(result.charts.errors.values())
        named = next((error for error in errors if isinstance(error, PASSING)), errors[0])
        partial = {"status": Outcome.PARTIAL, "error": type(named).__name__, "message": result.told(words)}
    return unwrapped_fields(result), mesh_file, stored_uv(result, mesh_file.mesh.sizes), partial


def _write(task: Task, image: MeshFile, corner_uv: Any) -> None:
    """The mesh, in one step, into a folder that is made where it is missing."""
    target = Path(task.target)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileFormatError(f"{target.parent}: the folder can not be made: {error.strerror or error}") from error
    write_mesh(target, image, corner_uv=corner_uv, split=task.plan.given.get("split", False))


def _stands(task: Task, told: dict[str, Any]) -> bool:
    """Whether the row of an earlier run holds still."""
    row = task.before
    if row is None or not row.status.lasts or row.error in {kind.__name__ for kind in PASSING}:
        return False
    if any(getattr(row, name) != told[name] for name in ("map", "options", "version", "input_hash")):
        return False
    if row.status is Outcome.REFUSED:
        return True
    try:
        return _hash(row.output) == row.output_hash
    except OSError:
        return False


def _input_hash(task: Task) -> str:
    """Of the input, and of its seams where they are in a file."""
    seams = task.plan.given.get("seams")
    try:
        hashes = [_hash(path) for path in (task.source, seams) if path not in (None, "uv")]
    except OSError as error:
        raise FileFormatError(f"{error.filename}: can not be read: {error.strerror or error}") from error
    return "+".join(hashes)


def _hash(path: str) -> str:
    found = hashlib.sha256()
    with open(path, "rb") as stream:
        while piece := stream.read(PIECE):
            found.update(piece)
    return found.hexdigest()


def _text(task: Task, error: Exception) -> str:
    if isinstance(error, ConformalUVError):
        return error.told(Remedy.as_flag if task.plan.flags else None)
    return str(error) or repr(error)


@contextmanager
def _warnings() -> Iterator[list[str]]:
    """What this thread's library warns of meanwhile."""
    handler = _Kept()
    LOG.addHandler(handler)
    try:
        yield handler.texts
    finally:
        LOG.removeHandler(handler)


class _Kept(logging.Handler):
    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.texts: list[str] = []
        self._thread = threading.get_ident()

    def emit(self, record: logging.LogRecord) -> None:
        if record.thread == self._thread:
            self.texts.append(record.getMessage())


def _peak() -> int | None:
    """Bytes that this process has had resident at most."""
    try:
        for line in Path("/proc/self/status").read_text().splitlines():  # getrusage tells a parent's too
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) * 1024
        import resource
    except (OSError, ImportError):
        return None
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)
