"""Objects unwrapped: all read, all solved, and only then written."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

import bpy
import numpy as np

from conformal_uv import Callback, CancelledError, ConformalUVError

from .edit_mode import object_mode
from .image_aspect import image_scale
from .kept_work import KEPT, KeptWork, Key
from .mesh_reading import fingerprint
from .mesh_writing import write_uv
from .packing import placed, tile_corner
from .properties import Options
from .results import UnwrapResult, in_words_of_the_panel, object_result
from .tasks import Task, gather


def solve(
    tasks: list[Task],
    options: Options,
    kept: KeptWork,
    *,
    callback: Callback | None = None,
    backend: str = "auto",
) -> set[Key]:
    """Solve every task, within Python and numpy alone: no bpy, so that a thread may run it.

    Returns
    -------
    set of Key
        What `kept` holds for these tasks.

    Raises
    ------
    CancelledError
    """
    keys = keys_of(tasks, options)
    todo = [task for task in tasks if task.surface is not None and not task.refusal]
    for number, task in enumerate(todo):
        try:
            told = _part(callback, number, len(todo))
            task.take(kept.unwrapped(task.surface, options, callback=told, backend=backend), options)
        except CancelledError:
            raise
        except ConformalUVError as error:
            task.refusal = in_words_of_the_panel(error)
    return keys


class ChangedMeanwhileError(Exception):
    """A mesh, or what is selected of it, is no longer what a thread has solved."""


def keys_of(tasks: list[Task], options: Options) -> set[Key]:
    """What KEPT holds of these tasks once they are solved."""
    return {task.surface.key(options) for task in tasks if task.surface is not None and not task.refusal}


def unwrap_objects(
    context: bpy.types.Context,
    objects: Iterable[bpy.types.Object],
    options: Options,
    *,
    expected: set[Key] | None = None,
) -> UnwrapResult:
    """Unwrap the objects' meshes as the options say; see the result for what could not be done.

    Parameters
    ----------
    expected : set of Key, optional
        What a thread has solved for them.

    Raises
    ------
    conformal_uv.OptionError
        Before anything is done.
    ChangedMeanwhileError
        Before anything is written, where the objects are no longer those.
    """
    start = time.perf_counter()
    corner = tile_corner(options)
    tasks = gather(context, objects, options)
    if expected is not None and keys_of(tasks, options) != expected:
        raise ChangedMeanwhileError
    KEPT.keep_only(solve(tasks, options, KEPT))
    done = [task for task in tasks if task.written.any()]
    middle = corner + 0.5
    together = context.mode == "EDIT_MESH" or options.place == "PACK"
    stored: dict[int, np.ndarray] = {}
    with object_mode(context):
        for group in [done] if together and done else [[task] for task in done]:
            for task, uv in zip(group, placed(group, options), strict=True):
                stored[id(task)] = _on_image(task, uv, image_scale(task.ob, options), middle)
        for task in done:
            _write(task, stored[id(task)])
        prints = {id(task): fingerprint(task.ob.data, task.layer) for task in done}
    results = [object_result(task, stored.get(id(task)), corner, prints.get(id(task), b"")) for task in tasks]
    return UnwrapResult(results, time.perf_counter() - start, options)


def _on_image(task: Task, uv: np.ndarray, scale: np.ndarray, middle: np.ndarray) -> np.ndarray:
    """UVs (k, 2) as the image has them: drawn together about the middle of the tile, islands with pins about 0."""
    if (scale == 1.0).all():
        return uv
    held = np.append(task.held, False)[task.solved.chart_of_face]
    about = np.where(np.repeat(held, np.diff(task.surface.arrays.starts))[:, None], 0.0, middle)
    return about + scale * (uv - about)


def _write(task: Task, uv: np.ndarray) -> None:
    mapped = task.mapped
    if task.subdivision is not None:
        uv, mapped = uv[task.subdivision.corner], task.subdivision.whole_faces(mapped)
        sizes = np.diff(task.subdivision.starts)
    else:
        sizes = np.diff(task.surface.arrays.starts)
    write_uv(task.ob.data, task.layer, uv, np.repeat(mapped, sizes))


def _part(callback: Callback | None, number: int, count: int) -> Callable[[str, float], object] | None:
    """The callback for one of several tasks, its fraction that of all."""
    if callback is None:
        return None
    return lambda stage, fraction: callback(stage, (number + fraction) / count)
