"""Processes of this package, started, watched and listened to."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from .memory import resident_memory

__all__ = ["child", "module"]

REPOSITORY = Path(__file__).resolve().parents[2]
PACKAGE = __package__ or "benchmarks.speed"
WATCH = 0.2  # seconds between two looks at a process


def module(name: str, *arguments: object) -> str:
    """Run a module of this package in a process of its own; what it prints.

    Raises
    ------
    RuntimeError
        It failed.
    """
    command = [sys.executable, "-m", f"{PACKAGE}.{name}", *map(str, arguments)]
    done = subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{name}: {last_line(done.stderr) or f'exit code {done.returncode}'}")
    return done.stdout


def child(python: str, job: dict[str, Any], file: Path, time_limit: float, memory_limit: float = 0.0) -> dict[str, Any]:
    """Run the measured process; what it told, or how it ended. The limits are of seconds and of gigabytes, or 0."""
    told = Path(job["told"])
    told.unlink(missing_ok=True)
    file.write_text(json.dumps(job))
    command = [python, "-m", f"{PACKAGE}.child", str(file)]
    try:
        with tempfile.TemporaryFile("w+") as errors:
            with subprocess.Popen(command, cwd=REPOSITORY, stdout=subprocess.DEVNULL, stderr=errors) as process:
                over = watched(process, time_limit, memory_limit)
            errors.seek(0)
            said = last_line(errors.read())
    except OSError as error:
        return {"status": "failed", "note": f"{python}: {error.strerror}"}
    if over:
        return {"status": "over", "note": over}
    if told.exists():
        return dict(json.loads(told.read_text()))
    if process.returncode < 0:
        name = signal.Signals(-process.returncode).name
        return {"status": "failed", "note": f"crashed ({name}{', out of memory?' if name == 'SIGKILL' else ''})"}
    return {"status": "failed", "note": said or f"exit code {process.returncode}"}


def watched(process: subprocess.Popen[bytes], time_limit: float, memory_limit: float) -> str:
    """Wait for a process and end it where it goes over a limit; which one, empty where it ended by itself.

    Limits that the system sets make some libraries hang instead of fail, so it is looked at from outside.
    """
    end = time.monotonic() + time_limit
    while True:
        try:
            process.wait(timeout=min(WATCH, max(end - time.monotonic(), 0.0)))
            return ""
        except subprocess.TimeoutExpired:
            pass
        over = f"over {time_limit:g} s" if time.monotonic() >= end else ""
        if memory_limit and (resident_memory(process.pid) or 0) > memory_limit * 1e9:
            over = f"over {memory_limit:g} GB"
        if over:
            process.kill()
            return over


def last_line(text: str) -> str:
    """What a program says at its end."""
    return (text.strip().splitlines() or [""])[-1][:200]
