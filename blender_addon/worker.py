"""Work done in a thread while the window stays alive.

The thread runs numpy and scipy alone and never touches Blender's data. What it factorizes goes by SuperLU: cvxopt's
CHOLMOD is faster but holds the interpreter's lock while it works, which would freeze the window like no thread at all.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from threading import Event, Thread

import bpy

from conformal_uv import Callback, CancelledError

from .words import as_blender_says, shown

SECONDS = 0.1  # between two looks at the thread
BACKEND = "superlu"  # for what runs in a thread

_under_way: list[Worker] = []


def under_way() -> bool:
    """Whether a thread works for a window now."""
    return bool(_under_way)


class Worker:
    """One piece of work under way.

    Parameters
    ----------
    name : str
        Told with the progress.
    job : callable
        Gets a callback for its progress, which ends it when it returns False; run once, in the thread.

    Attributes
    ----------
    fraction : float
        How far the thread has come.
    """

    def __init__(self, name: str, job: Callable[[Callback], None]) -> None:
        self._name, self._job = name, job
        self._stop = Event()
        self._stage, self.fraction = "", 0.0
        self._error: Exception | None = None
        self._thread = Thread(target=self._run, name="conformal_uv", daemon=True)
        self._timer: bpy.types.Timer | None = None
        self._begun = 0.0

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
        _under_way.append(self)
        self._thread.start()
        self.show(context)

    def show(self, context: bpy.types.Context) -> None:
        """Tell stage and fraction in the status bar, the editor's header and at the cursor."""
        percent = int(100 * self.fraction)
        context.window_manager.progress_update(percent)
        self._write(
            context, f"{shown(self._name)}: {as_blender_says(self._stage)} {percent} %      {shown('Esc: Cancel')}"
        )

    def finish(self, context: bpy.types.Context) -> float:
        """Put the window back; the seconds spent. Raises what went wrong in the thread."""
        self._put_back(context)
        if self._error is not None:
            raise self._error
        return time.perf_counter() - self._begun

    def cancel(self, context: bpy.types.Context) -> None:
        """Let the thread stop at its next report; it is not waited for."""
        self._stop.set()
        self._put_back(context)

    def _put_back(self, context: bpy.types.Context) -> None:
        if self._timer is None:
            return
        _under_way.remove(self)
        context.window_manager.event_timer_remove(self._timer)
        self._timer = None
        context.window_manager.progress_end()
        self._write(context, None)

    def _write(self, context: bpy.types.Context, text: str | None) -> None:
        if context.workspace is not None:
            context.workspace.status_text_set(text)
        if context.area is not None:
            context.area.header_text_set(text)

    def _run(self) -> None:
        try:
            self._job(self._told)
        except CancelledError:
            return
        except Exception as error:  # noqa: BLE001 - told to the user by the main thread
            self._error = error

    def _told(self, stage: str, fraction: float) -> bool:
        self._stage, self.fraction = stage, fraction
        return not self._stop.is_set()
