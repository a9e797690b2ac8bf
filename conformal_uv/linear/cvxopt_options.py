"""cvxopt's global options of CHOLMOD: ours while we call it, the user's before and after.

Every call of cvxopt.cholmod reads one dictionary. A lock keeps two of our threads from seeing each other's entries,
and what the user has there is put back and has no part in our results.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["cholmod_options"]

_LOCK = threading.RLock()


@contextmanager
def cholmod_options(**ours: int) -> Iterator[None]:
    """Run the block with CHOLMOD's defaults and these options, one thread at a time."""
    from cvxopt import cholmod

    with _LOCK:
        given = dict(cholmod.options)
        cholmod.options.clear()
        cholmod.options.update(ours)
        try:
            yield
        finally:
            cholmod.options.clear()
            cholmod.options.update(given)
