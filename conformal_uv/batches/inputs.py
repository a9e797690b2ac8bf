"""The meshes of a batch: files, patterns, folders and manifests, each with the place of its map."""

from __future__ import annotations

import glob
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from ..errors import OptionError
from ..files import READABLE, WRITABLE
from .estimate import estimated_memory, estimated_vertices
from .manifest import MANIFESTS, Entry, read_manifest
from .plan import Plan
from .row import BatchRow
from .task import Task

__all__ = ["found_tasks"]

PACKED = ".gz"
FIRST = ".obj"  # of what is read but not written


def found_tasks(
    inputs: str | os.PathLike[str] | Iterable[str | os.PathLike[str]],
    out: Path,
    plan: Plan,
    before: Mapping[str, BatchRow],
) -> list[Task]:
    """A task for each input, in the order in which they are given.

    A folder stands for all meshes in it and below, a pattern (``scans/**/*.ply``) for what it matches, a CSV or JSON
    file for the meshes that it lists. Below `out` a map lies as its mesh lies in the folder, below the fixed part of
    the pattern, or below the folder that all plain files have in common.

    Parameters
    ----------
    before : mapping of str to BatchRow
        Rows of earlier runs by their outputs.

    Raises
    ------
    OptionError
        There are no inputs, two maps would have one place, or one that of its input.
    FileFormatError
        A manifest can not be read.
    """
    given = [os.fspath(one) for one in ([inputs] if isinstance(inputs, str | os.PathLike) else inputs)]
    found: list[Entry] = []
    plain: list[Entry] = []
    for one in given:
        if Path(one).suffix.lower() in MANIFESTS:
            found += _placed(read_manifest(Path(one)))
        elif os.path.isdir(one):
            found += _in_folder(one, out)
        elif glob.has_magic(one) and not os.path.exists(one):
            found += _matching(one)
        else:
            plain.append(Entry(os.path.abspath(one)))
    found += _placed(plain)
    if not found:
        raise OptionError(f"No meshes in {', '.join(given) or 'no inputs'}; give files, folders or patterns.")
    return _distinct([_task(entry, out, plan, before) for entry in found])


def _in_folder(folder: str, out: Path) -> list[Entry]:
    """All meshes in it and below, but for those in the folder of the maps."""
    base, kept_out = os.path.abspath(folder), os.path.realpath(out)
    found = []
    for inside, below, names in os.walk(base):
        below[:] = sorted(name for name in below if os.path.realpath(os.path.join(inside, name)) != kept_out)
        found += [os.path.join(inside, name) for name in sorted(names) if _is_mesh(name)]
    return [Entry(path, os.path.relpath(path, base)) for path in found]


def _is_mesh(name: str) -> bool:
    path = Path(name.lower().removesuffix(PACKED))
    return path.suffix in READABLE and not name.startswith(".")


def _matching(pattern: str) -> list[Entry]:
    """All files that a pattern matches, placed as below its fixed part."""
    found = sorted(os.path.abspath(path) for path in glob.glob(pattern, recursive=True) if os.path.isfile(path))
    if not found:
        raise OptionError(f"No file matches {pattern!r}; give files, folders or other patterns.")
    fixed = Path(pattern)
    while glob.has_magic(str(fixed)):
        fixed = fixed.parent
    return [Entry(path, os.path.relpath(path, fixed)) for path in found]


def _placed(entries: list[Entry]) -> list[Entry]:
    """Entries without a place of their own, placed as below the folder that they have in common."""
    free = [entry for entry in entries if entry.output is None]
    if not free:
        return entries
    base = os.path.commonpath([os.path.dirname(entry.input) for entry in free])
    return [
        Entry(entry.input, os.path.relpath(entry.input, base), entry.options) if entry.output is None else entry
        for entry in entries
    ]


def _task(entry: Entry, out: Path, plan: Plan, before: Mapping[str, BatchRow]) -> Task:
    assert entry.output is not None
    own = plan.changed(entry.options)
    target = os.path.abspath(out / _written(Path(entry.output), own.given))
    if os.path.realpath(target) == os.path.realpath(entry.input):
        raise OptionError(f"{entry.input} would be replaced by its map; choose another folder for the maps.")
    n = estimated_vertices(entry.input)
    return Task(entry.input, target, own, n, estimated_memory(n, own.kind), before.get(target))


def _written(path: Path, given: Mapping[str, Any]) -> Path:
    """The name with the suffix of the format that is written."""
    if path.suffix.lower() == PACKED:
        path = path.with_suffix("")
    if "format" in given:
        return path.with_suffix(f".{given['format']}")
    return path if path.suffix.lower() in WRITABLE else path.with_suffix(FIRST)


def _distinct(tasks: list[Task]) -> list[Task]:
    """Each once; one place is for one mesh."""
    found: dict[str, Task] = {}
    for task in tasks:
        other = found.setdefault(task.target, task)
        if other is not task and (other.source, other.plan) != (task.source, task.plan):
            raise OptionError(
                f"{other.source} and {task.source} would both be mapped to {task.target}; rename one, give their "
                "folder, or list them in a manifest with outputs."
            )
    return list(found.values())
