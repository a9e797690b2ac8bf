"""Seconds of each stage, and a progress bar on a terminal."""

from __future__ import annotations

import logging
import time
from types import TracebackType

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn

from .terminal import WarningsOnStderr

__all__ = ["Stages"]

LOG = logging.getLogger("conformal_uv")


class Stages:
    """A callback for the maps that times their stages and shows them.

    Parameters
    ----------
    quiet : bool
        No bar. Without a terminal on stderr there is none either.

    Attributes
    ----------
    seconds : dict of str to float
        Wall time spent in each stage so far, in the order of their first appearance.
    """

    def __init__(self, *, quiet: bool) -> None:
        self.seconds: dict[str, float] = {}
        self._stage: str | None = None
        self._since = 0.0
        self._warnings = WarningsOnStderr(quiet=quiet)
        console = Console(stderr=True)
        self._bar: Progress | None = None
        if console.is_terminal and not quiet:
            self._bar = Progress(
                TextColumn("{task.description:>16}"),
                BarColumn(),
                TaskProgressColumn(),
                TimeElapsedColumn(),
                console=console,
                transient=True,
            )
            self._task = self._bar.add_task("", total=1.0)

    def __call__(self, stage: str, fraction: float) -> None:
        """Take note that `stage` has come to `fraction`."""
        now = time.perf_counter()
        if self._stage is not None:
            self.seconds[self._stage] = self.seconds.get(self._stage, 0.0) + now - self._since
        self._stage, self._since = stage, now
        if self._bar is not None:
            self._bar.update(self._task, description=stage, completed=fraction)

    def __enter__(self) -> Stages:
        LOG.addHandler(self._warnings)
        if self._bar is not None:
            self._bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self("", 1.0)
        self._stage = None
        if self._bar is not None:
            self._bar.stop()
        LOG.removeHandler(self._warnings)
