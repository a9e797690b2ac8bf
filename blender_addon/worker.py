"""The solution computed in a thread while the window stays alive.

The thread runs numpy and scipy alone, never bpy. It factorizes by SuperLU: cvxopt's CHOLMOD is faster but holds the
interpreter's lock while it works, which would freeze the window like no thread at all.
"""

from __future__ import annotations

import time
from collections.abc import Iterable
from threading import Event, Thread

import bpy

from conformal_uv import CancelledError

from .kept_work import KEPT
from .properties import Options
from .tasks import gather
from .unwrap_objects import solve

SECONDS = 0.1  # between two looks at the thread


class Worker:
    """One unwrap under way; its result ends up in KEPT, where the operator's execute finds it.

    Parameters
    ----------
    context : bpy.types.Context
    objects : objects to unwrap
    options : Options

    Attributes
    ----------
    fraction : float
        How far the thread has come.
    """

    def __init__(self, context: bpy.types.Context, objects: Iterable[bpy.types.Object], options: Options) -> None:
        self._tasks = gather(context, objects, options)
        self._options = options
        self._kept = KEPT.fork()
        self._stop = Event()
        self._stage, self.fraction = "", 0.0
        self._error: Exception | None = None
        self._thread = Thread(target=self._run, name="conformal_uv", daemon=True)
        self._timer: bpy.types.Timer | None = None
        self._begun = 0.0

    @property
    def faces(self) -> int:
        """Faces to unwrap."""
        return sum(int(task.surface.chosen.sum()) for task in self._tasks if task.surface is not None)

    @property
    def running(self) -> bool:
        """Whether the thread still works."""
        return self._thread.is_alive()

    def start(self, context: bpy.types.Context) -> None:
        """Start the thread and a timer that sends TIMER events."""
        manager = context.window_manager
        manager.progress_begin(0, 100)
        self._timer = manager.event_timer_add(SECONDS, window=context.window)
        self._begun = time.perf_counter()
        self._thread.start()
        self.show(context)

    def show(self, context: bpy.types.Context) -> None:
        """Tell stage and fraction in the status bar and at the cursor."""
        percent = int(100 * self.fraction)
        context.window_manager.progress_update(percent)
        context.workspace.status_text_set(f"Conformal Unwrap: {self._stage} {percent} %      Esc: Cancel")

    def finish(self, context: bpy.types.Context) -> float:
        """Hand the work over and put the window back; the seconds spent. Raises what went wrong in the thread."""
        self._put_back(context)
        if self._error is not None:
            raise self._error
        KEPT.adopt(self._kept)
        return time.perf_counter() - self._begun

    def cancel(self, context: bpy.types.Context) -> None:
        """Let the thread stop at its next report; it is not waited for and what it shares is forgotten."""
        self._stop.set()
        KEPT.keep_only(set())
        self._put_back(context)

    def _put_back(self, context: bpy.types.Context) -> None:
        manager = context.window_manager
        if self._timer is not None:
            manager.event_timer_remove(self._timer)
            self._timer = None
            manager.progress_end()
            if context.workspace is not None:
                context.workspace.status_text_set(None)

    def _run(self) -> None:
        try:
            solve(self._tasks, self._options, self._kept, callback=self._told, backend="superlu")
        except CancelledError:
            return
        except Exception as error:  # noqa: BLE001 - told to the user by the main thread
            self._error = error

    def _told(self, stage: str, fraction: float) -> bool:
        self._stage, self.fraction = stage, fraction
        return not self._stop.is_set()
