"""Memory of this process, in bytes."""

from __future__ import annotations

import contextlib
import resource
import sys
from pathlib import Path

__all__ = ["die_first", "limit_memory", "peak_memory", "resident_memory"]

STATUS = Path("/proc/self/status")


def peak_memory() -> int:
    """The most that has been resident at once.

    Linux hands the peak of the parent down to a new process in ``ru_maxrss``; ``VmHWM`` is the process's own.
    """
    told = _status("VmHWM")
    if told is not None:
        return told
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


def resident_memory() -> int:
    """What is resident now; the peak where the system does not tell."""
    told = _status("VmRSS")
    return peak_memory() if told is None else told


def limit_memory(gigabytes: float) -> None:
    """From now on allocations beyond this fail, with MemoryError where the program looks."""
    if gigabytes:
        most = int(gigabytes * 1e9)
        resource.setrlimit(resource.RLIMIT_DATA, (most, most))


def die_first() -> None:
    """When the system runs out of memory it ends this process and not the one that keeps the table."""
    with contextlib.suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text("1000")


def _status(name: str) -> int | None:
    try:
        lines = STATUS.read_text().splitlines()
    except OSError:
        return None
    return next((int(line.split()[1]) * 1024 for line in lines if line.startswith(f"{name}:")), None)
