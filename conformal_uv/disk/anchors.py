"""Options that name vertices, checked against a surface."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..errors import OptionError
from ..options import DiskOptions

__all__ = ["anchored"]


def anchored(options: DiskOptions, n: int, loop: NDArray[np.int64]) -> DiskOptions:
    """The options on a surface of n vertices with this boundary loop; pins that are left out are filled in.

    Raises
    ------
    OptionError
        Vertices that do not exist or are not where they must be.
    """
    options = replace(options, pins=_pins(options, n, loop))
    for name in ("center", "boundary_vertex"):
        _check_exists(name, getattr(options, name), n)
    if options.center is not None and options.center in loop:
        raise OptionError(f"center {options.center} lies on the boundary; choose an interior vertex.")
    if options.boundary_vertex is not None and options.boundary_vertex not in loop:
        raise OptionError(f"boundary_vertex {options.boundary_vertex} is not on the boundary.")
    return options


def _check_exists(name: str, vertex: int | None, n: int) -> None:
    if vertex is not None and not 0 <= vertex < n:
        raise OptionError(f"{name} is vertex {vertex}; the mesh has vertices 0 .. {n - 1}.")


def _pins(options: DiskOptions, n: int, loop: NDArray[np.int64]) -> tuple[int, int, int] | None:
    """Three boundary vertices in the order of the loop; by default those a third of its vertices apart."""
    nb = len(loop)
    if options.pins is None:
        if not options.needs_pins:
            return None
        first, second, third = (int(loop[k]) for k in (0, nb // 3, 2 * (nb // 3)))
        return first, second, third
    a, b, c = options.pins
    for pin in options.pins:
        _check_exists("pins", pin, n)
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
