"""Options of a map to the disk, checked against the mesh."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from operator import index
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import OptionError
from ..mesh.surface import Surface

__all__ = ["DiskOptions", "Method", "Objective", "PinMode", "checked_limits", "real_number"]

Method = Literal["linear", "newton", "augmented-lagrangian"]
Objective = Literal["conformal", "dirichlet"]
PinMode = Literal["moebius", "constraint"]

CHOICES = {
    "method": ("linear", "newton", "augmented-lagrangian"),
    "objective": ("conformal", "dirichlet"),
    "pin_mode": ("moebius", "constraint"),
    "repair": ("auto", "never"),
}


@dataclass(frozen=True)
class DiskOptions:
    """What to solve and how to place it; see `disk_map`."""

    method: Method
    objective: Objective
    pins: tuple[int, int, int] | None
    pin_mode: PinMode
    center: int | None
    boundary_vertex: int | None
    tolerance: float
    relative_tolerance: float
    max_iterations: int
    repair: str

    @property
    def constrained_pins(self) -> tuple[int, int, int] | None:
        """Pins that are constraints of the optimisation."""
        return self.pins if self.pin_mode == "constraint" else None

    @property
    def solution_key(self) -> tuple[object, ...]:
        """What the solution depends on before it is placed."""
        limits = self.tolerance, self.relative_tolerance, self.max_iterations
        return self.method, self.objective, *limits, self.constrained_pins

    @classmethod
    def checked(
        cls,
        surface: Surface,
        loop: NDArray[np.int64],
        *,
        method: str,
        objective: str | None,
        pins: Sequence[int] | None,
        pin_mode: str | None,
        center: int | None,
        boundary_vertex: int | None,
        tolerance: float,
        relative_tolerance: float,
        max_iterations: int,
        repair: str,
    ) -> DiskOptions:
        """Fill in what was left out.

        Raises
        ------
        OptionError
            A value that is not taken, vertices that are not where they must be, or options that exclude each
            other.
        """
        report = method == "augmented-lagrangian"
        objective = ("dirichlet" if report else "conformal") if objective is None else objective
        pin_mode = ("constraint" if report else "moebius") if pin_mode is None else pin_mode
        given = {"method": method, "objective": objective, "pin_mode": pin_mode, "repair": repair}
        for name, value in given.items():
            if not isinstance(value, str) or value not in CHOICES[name]:
                raise OptionError(f"{name} is {value!r}; choose {' or '.join(CHOICES[name])}.")
        if report and pin_mode != "constraint":
            raise OptionError('The augmented Lagrangian takes its pins as constraints; leave pin_mode out.')
        if method == "linear" and pin_mode == "constraint":
            raise OptionError('The linear method does not optimise; it takes pins only with pin_mode="moebius".')
        tolerance, relative_tolerance, max_iterations = checked_limits(tolerance, max_iterations, relative_tolerance)
        pinned = _pins(pins, loop, surface.n, default=report or pin_mode == "constraint")
        if pinned is not None and (center is not None or boundary_vertex is not None):
            raise OptionError("Three pins already fix the map; leave out center and boundary_vertex.")
        if center is not None:
            center = _vertex("center", center, surface.n)
            if center in loop:
                raise OptionError(f"center {center} lies on the boundary; choose an interior vertex.")
        if boundary_vertex is not None:
            boundary_vertex = _vertex("boundary_vertex", boundary_vertex, surface.n)
            if boundary_vertex not in loop:
                raise OptionError(f"boundary_vertex {boundary_vertex} is not on the boundary.")
        return cls(
            method,  # type: ignore[arg-type]
            objective,  # type: ignore[arg-type]
            pinned,
            pin_mode,  # type: ignore[arg-type]
            center,
            boundary_vertex,
            tolerance,
            relative_tolerance,
            max_iterations,
            repair,
        )


def _vertex(name: str, value: int, n: int) -> int:
    try:
        vertex = index(value)
    except TypeError as error:
        raise OptionError(f"{name} is {value!r}; pass a vertex index.") from error
    if not 0 <= vertex < n:
        raise OptionError(f"{name} is vertex {vertex}; the mesh has vertices 0 .. {n - 1}.")
    return vertex


def real_number(name: str, value: object, what: str = "a number") -> float:
    """The value as a finite float.

    Raises
    ------
    OptionError
        It is none.
    """
    if isinstance(value, str | bytes | bool | np.bool_):
        raise OptionError(f"{name} is {value!r}; pass {what}.")
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError) as error:
        raise OptionError(f"{name} is {value!r}; pass {what}.") from error
    if not np.isfinite(number):
        raise OptionError(f"{name} is {value!r}; pass {what}.")
    return number


def checked_limits(
    tolerance: float, max_iterations: int, relative_tolerance: float = 0.0
) -> tuple[float, float, int]:
    """Tolerance, relative tolerance and number of iterations.

    Raises
    ------
    OptionError
        No numbers, or out of range.
    """
    given = tolerance, relative_tolerance, max_iterations
    try:
        if any(isinstance(value, str | bytes | bool | np.bool_) for value in given):
            raise TypeError
        norm, part, most = float(tolerance), float(relative_tolerance), index(max_iterations)
    except (TypeError, ValueError) as error:
        raise OptionError(
            f"tolerance is {tolerance!r}, relative_tolerance {relative_tolerance!r}, max_iterations "
            f"{max_iterations!r}; pass numbers."
        ) from error
    if not 0.0 < norm < np.inf or most < 0:
        raise OptionError(f"tolerance must be positive and max_iterations not negative; got {norm} and {most}.")
    if not 0.0 <= part < 1.0:
        raise OptionError(f"relative_tolerance must be at least 0 and less than 1; got {part}.")
    return norm, part, most


def _pins(
    pins: Sequence[int] | None, loop: NDArray[np.int64], n: int, *, default: bool
) -> tuple[int, int, int] | None:
    """Three boundary vertices in the order of the loop; by default those a third of its vertices apart."""
    nb = len(loop)
    if pins is None:
        if not default:
            return None
        first, second, third = (int(loop[k]) for k in (0, nb // 3, 2 * (nb // 3)))
        return first, second, third
    try:
        values = list(pins)
    except TypeError as error:
        raise OptionError(f"pins is {pins!r}; pass three boundary vertices.") from error
    if len(values) != 3:
        raise OptionError(f"{len(values)} pins; pass three boundary vertices.")
    a, b, c = (_vertex("pins", v, n) for v in values)
    place = [np.flatnonzero(loop == v) for v in (a, b, c)]
    outside = [v for v, found in zip((a, b, c), place, strict=True) if not len(found)]
    if outside:
        raise OptionError(f"Pins {outside} are not on the boundary; pass three boundary vertices.")
    i, j, k = (int(found[0]) for found in place)
    if len({i, j, k}) < 3:
        raise OptionError(f"Pins {a}, {b}, {c} are not three different vertices.")
    if (j - i) % nb > (k - i) % nb:
        raise OptionError(
            f"Pins {a}, {b}, {c} follow each other against the boundary's direction, which would mirror the "
            f"surface; pass {a}, {c}, {b}."
        )
    return a, b, c
