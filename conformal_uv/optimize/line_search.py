"""Backtracking along a direction of descent, down to the resolution of the energy in doubles."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeVar

__all__ = ["SUFFICIENT_DECREASE", "line_search"]

SUFFICIENT_DECREASE = 1e-4  # Armijo's constant
HALVINGS = 30


class Iterate(Protocol):
    """Anything with an energy."""

    @property
    def value(self) -> float: ...


Place = TypeVar("Place", bound=Iterate)


def line_search(
    here: float,
    slope: float,
    move: Callable[[float], Place | None],
    gradient_falls: Callable[[Place], bool],
    *,
    length: float,
    noise: float,
    halvings: int = HALVINGS,
) -> tuple[float, Place] | None:
    """Halve the step until the energy falls enough; None where no step does.

    Where the change is within the `noise` of the energy, a step counts when it lowers the projected gradient.

    Parameters
    ----------
    here : float
        The energy where the search begins.
    slope : float
        Its derivative along the direction.
    move : callable
        The iterate after a step of this length, None where the step must not be taken.
    gradient_falls : callable
        Whether the projected gradient there is smaller than here.
    length : float
        The first step.
    noise : float
        Rounding of the difference of two energies.
    halvings : int
        Lengths that are tried.
    """
    for _ in range(halvings):
        there = move(length)
        if there is not None:
            change = there.value - here
            if change <= SUFFICIENT_DECREASE * length * slope and change < -noise:
                return length, there
            if abs(change) <= noise and gradient_falls(there):
                return length, there
        length *= 0.5
    return None
