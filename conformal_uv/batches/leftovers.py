"""What processes leave that are killed while they write."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterable

from ..files.atomic import TEMPORARY

__all__ = ["clear_leftovers"]


def clear_leftovers(targets: Iterable[str]) -> None:
    """Remove temporary files beside these targets; nobody may be writing there."""
    for folder in {os.path.dirname(target) for target in targets}:
        with contextlib.suppress(OSError):
            for name in os.listdir(folder):
                if TEMPORARY.fullmatch(name):
                    os.unlink(os.path.join(folder, name))
