"""Memory of processes, in bytes, and what the system takes of their time, most of it to hand out memory.

``python -m benchmarks.speed.memory GIGABYTES`` uses some once. A virtual machine gets memory from its host at the first
touch, slowly; without this the first contestant to need so much would pay for it and the others would not.
"""

from __future__ import annotations

import contextlib
import resource
import sys
from pathlib import Path

__all__ = ["die_first", "peak_memory", "resident_memory", "system_seconds"]


def peak_memory() -> int:
    """The most that has been resident at once.

    Linux hands the peak of the parent down to a new process in ``ru_maxrss``; ``VmHWM`` is the process's own.
    """
    told = _status("VmHWM")
    if told is not None:
        return told
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


def resident_memory(process: int | str = "self") -> int | None:
    """What is resident now, of this process or of another; None where the system does not tell."""
    return _status("VmRSS", process)


def system_seconds() -> float:
    """Processor time that the system has spent for this process."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_stime


def die_first() -> None:
    """When the system runs out of memory it ends this process and not the one that keeps the table."""
    with contextlib.suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text("1000")


def _status(name: str, process: int | str = "self") -> int | None:
    try:
        lines = Path(f"/proc/{process}/status").read_text().splitlines()
    except OSError:
        return None
    return next((int(line.split()[1]) * 1024 for line in lines if line.startswith(f"{name}:")), None)


if __name__ == "__main__":
    used = b"\1" * int(float(sys.argv[1]) * 1e9)
