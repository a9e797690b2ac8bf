"""Memory at hand, and what a direct factorization is going to take of it."""

from __future__ import annotations

import importlib.util
import logging
import math
import os
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

__all__ = ["factorization_fits", "factorization_memory", "memory_at_hand"]

log = logging.getLogger(__name__)

PROC = Path("/proc")
CGROUPS = Path("/sys/fs/cgroup")

# Bytes over n log2 n, to which George's nested dissection brings the factor of a planar mesh: the growth of the
# process's peak from before the factorization to after two solutions, both libraries in the order of
# nested_dissection, matrix given. The constants are the largest measured, rounded up.
#
#   n                   9,604    99,225    248,004    996,004    272,817 (a face scanned, thin triangles)
#   cholmod              74.6      58.7       56.7       54.3       71.3
#   superlu              92.0      90.3       92.9       92.2      117.3
#
# In the orders that the libraries find themselves, at n = 996,004: cholmod 56.0, superlu 107.2.
BYTES = {"cholmod": 75.0, "superlu": 120.0}
LITTLE = 1 << 26  # bytes, for which nobody is asked


def factorization_fits(n: int, backend: str) -> bool:
    """Whether a direct factorization by this backend fits into the memory at hand; True where that is unknown."""
    needed = factorization_memory(n, backend)
    if needed < LITTLE:
        return True
    at_hand = memory_at_hand()
    if at_hand is not None:
        log.debug("%s of %d unknowns: about %d MB of %d at hand", backend, n, needed >> 20, at_hand >> 20)
    return at_hand is None or needed <= at_hand


def factorization_memory(n: int, backend: str) -> int:
    """Bytes that a direct factorization of a mesh with n interior vertices takes at its peak, about.

    Parameters
    ----------
    backend : {"cholmod", "superlu"}
    """
    return int(BYTES[backend] * n * math.log2(max(n, 2)))


def memory_at_hand() -> int | None:
    """Bytes that this process can still take without swapping or being stopped; None where nothing tells."""
    bounds = [bound for bound in (_available(), *_cgroup_rests(), _address_space_rest()) if bound is not None]
    return max(min(bounds), 0) if bounds else None


def _available() -> int | None:
    """What the system has left, its caches included, which it gives up."""
    if importlib.util.find_spec("psutil") is not None:
        import psutil

        return int(psutil.virtual_memory().available)
    kilobytes = _table(PROC / "meminfo").get("MemAvailable:")
    return None if kilobytes is None else 1024 * kilobytes


def _cgroup_rests() -> Iterator[int]:
    """What is left under the limit of each control group around this process, as containers and batch systems set."""
    for line in _text(PROC / "self" / "cgroup").splitlines():
        _, controllers, path = line.split(":", 2)
        if controllers == "":  # version 2
            root, most, now, cache = CGROUPS, "memory.max", "memory.current", "inactive_file"
        elif "memory" in controllers.split(","):  # version 1
            root, most, now = CGROUPS / "memory", "memory.limit_in_bytes", "memory.usage_in_bytes"
            cache = "total_inactive_file"
        else:
            continue
        inner = PurePosixPath(path.lstrip("/"))
        for group in (inner, *inner.parents):
            limit, used = _text(root / group / most).strip(), _text(root / group / now).strip()
            if limit.isdigit() and used.isdigit():  # no limit reads "max"
                yield int(limit) - int(used) + _table(root / group / "memory.stat").get(cache, 0)


def _address_space_rest() -> int | None:
    """What is left under the limit on the address space (ulimit -v)."""
    try:
        import resource
    except ImportError:  # Windows
        return None
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    if limit == resource.RLIM_INFINITY:
        return None
    pages = _text(PROC / "self" / "statm").split()
    return limit - (int(pages[0]) * os.sysconf("SC_PAGE_SIZE") if pages else 0)


def _table(path: Path) -> dict[str, int]:
    """The lines ``name number ...`` of a file by their names, empty where it can not be read."""
    rows = (line.split() for line in _text(path).splitlines())
    return {row[0]: int(row[1]) for row in rows if len(row) > 1 and row[1].isdigit()}


def _text(path: Path) -> str:
    """Content of a small file, empty where it can not be read."""
    try:
        return path.read_text()
    except OSError:
        return ""
