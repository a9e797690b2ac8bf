"""What a contestant hands back, and how it tells of its stages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Arrays", "Outcome", "Stage"]

Arrays = dict[str, NDArray[Any]]
"""``V`` (n, 3) float64 and ``F`` (m, 3 or 4) int64; a matrix' ``data``, ``indices``, ``indptr``; or ``path``."""

Stage = Callable[[str], None]
"""Called at the beginning of each stage with its name."""


@dataclass(frozen=True)
class Outcome:
    """The map, and what is asked of it after the clock has stopped.

    Attributes
    ----------
    uv : (n, 2) or (n, 3) float64, or None
    later : dict
        Numbers to compute afterwards, each timed by itself.
    stages : dict
        Seconds of the stages, where the contestant itself tells them.
    """

    uv: NDArray[np.float64] | None = None
    later: dict[str, Callable[[], float]] = field(default_factory=dict)
    stages: dict[str, float] = field(default_factory=dict)
