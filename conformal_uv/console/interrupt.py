"""Ctrl-C in the commands: exit code 130 and no traceback."""

from __future__ import annotations

import functools
import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import ParamSpec

__all__ = ["interruptible", "quiet_interrupt"]

P = ParamSpec("P")


INTERRUPTED = 130  # of a shell's command that SIGINT ended


@contextmanager
def quiet_interrupt() -> Iterator[None]:
    """While modules load, Ctrl-C ends the process at once with code 130 and without a word."""
    if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield  # ignored, or somebody else's
        return
    signal.signal(signal.SIGINT, lambda *_: os._exit(INTERRUPTED))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def interruptible(command: Callable[P, None]) -> Callable[P, None]:
    """The command, which Ctrl-C ends with code 130; outputs are replaced whole or not at all."""

    @functools.wraps(command)
    def run(*args: P.args, **kwargs: P.kwargs) -> None:
        try:
            command(*args, **kwargs)
        except KeyboardInterrupt as error:
            raise SystemExit(INTERRUPTED) from error

    return run
