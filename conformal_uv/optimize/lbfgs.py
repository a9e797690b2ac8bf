"""Limited-memory BFGS from a given first Hessian, for energies that are infinite beyond a barrier.

J. Nocedal, "Updating quasi-Newton matrices with limited storage", Mathematics of Computation 35, 1980.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Protocol, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..progress import Progress
from .history import Status
from .line_search import line_search

__all__ = ["Barrier", "lbfgs"]

Real = NDArray[np.float64]

KEPT = 10  # pairs of steps and changes of the gradient
SHARE = 0.9  # of the way to the barrier


class Barrier(Protocol):
    """A place with an energy that is finite there."""

    @property
    def value(self) -> float:
        """The energy."""
        ...

    @property
    def gradient(self) -> Real:
        """Its gradient, (k,)."""
        ...

    def room(self, direction: Real) -> float:
        """Length of the step along a direction (k,) at which the barrier stands, infinite where there is none."""
        ...

    def moved(self, step: Real) -> Self | None:
        """The place after a step (k,); None beyond the barrier."""
        ...


Place = TypeVar("Place", bound=Barrier)


class _Memory:
    """The inverse Hessian as the first one and the steps since."""

    def __init__(self, first_inverse: Callable[[Real], Real]) -> None:
        self._first = first_inverse
        self._pairs: deque[tuple[Real, Real, float]] = deque(maxlen=KEPT)

    def applied(self, gradient: Real) -> Real:
        out, parts = gradient.copy(), []
        for step, change, curvature in reversed(self._pairs):
            parts.append(float(step @ out) / curvature)
            out -= parts[-1] * change
        out = self._first(out)
        for (step, change, curvature), part in zip(self._pairs, reversed(parts), strict=True):
            out += (part - float(change @ out) / curvature) * step
        return out

    def add(self, step: Real, change: Real) -> None:
        curvature = float(step @ change)
        if curvature > 0.0:
            self._pairs.append((step, change, curvature))


def lbfgs(
    place: Place,
    first_inverse: Callable[[Real], Real],
    *,
    tolerance: float,
    max_iterations: int,
    progress: Progress,
    stage: str,
    watch: Callable[[Place], None] = lambda place: None,
) -> tuple[Place, Status]:
    """The last place, and why it is the last.

    Parameters
    ----------
    place : Barrier
        Where to begin.
    first_inverse : callable
        The inverse of the first Hessian, applied to a gradient (k,).
    tolerance : float
        Part of the energy; a step that lowers it by less is the last.
    watch : callable, optional
        Called with every place after a step.
    """
    memory = _Memory(first_inverse)
    for iteration in range(max_iterations):
        progress(stage, iteration / max_iterations)
        direction = -memory.applied(place.gradient)
        slope = float(place.gradient @ direction)
        if not slope < 0.0:
            return place, Status.STALLED
        found = _searched(place, direction, slope)
        if found is None:
            return place, Status.STALLED
        length, there = found
        memory.add(length * direction, there.gradient - place.gradient)
        fallen = place.value - there.value
        place = there
        watch(place)
        if fallen <= tolerance * place.value:
            return place, Status.CONVERGED
    return place, Status.MAX_ITERATIONS


def _searched(place: Place, direction: Real, slope: float) -> tuple[float, Place] | None:
    """A step that lowers the energy and stays before the barrier."""
    return line_search(
        place.value,
        slope,
        lambda length: place.moved(length * direction),
        lambda there: False,
        length=min(1.0, SHARE * place.room(direction)),
        noise=float(np.finfo(np.float64).eps) * place.value,
    )
