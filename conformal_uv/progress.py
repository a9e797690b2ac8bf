"""Progress and cancelling of long work."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .errors import CancelledError

__all__ = ["Callback", "Progress"]

Callback = Callable[[str, float], object]


class Progress:
    """Passes (stage, fraction) on to the user's callback, which stops the work by returning False."""

    def __init__(self, callback: Callback | None = None) -> None:
        self._callback = callback

    def __call__(self, stage: str, fraction: float) -> None:
        """Report that `stage` has come to `fraction` (0 at its start, 1 at its end).

        Raises
        ------
        CancelledError
            The callback returned False.
        """
        if self._callback is None:
            return
        answer = self._callback(stage, float(fraction))
        if isinstance(answer, bool | np.bool_) and not answer:
            raise CancelledError(f"Cancelled during {stage}; nothing was changed.")
