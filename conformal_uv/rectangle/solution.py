"""The two coordinates of a rectangle: harmonic, 0 and 1 on opposite sides, no flux through the others.

So are the real and the imaginary part of the conformal map onto the rectangle, up to their sizes; the modulus is what
brings those together. Each is a mixed problem of its own, with a factorization of its own: the unknowns are the
vertices inside and those of the two sides that are free.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..mesh.surface import Surface
from ..operators.dirichlet import DirichletProblem
from ..operators.edge_laplacian import EdgeLaplacian
from ..progress import Progress

__all__ = ["RectangleSolution", "rectangle_sides", "solve_rectangle"]

Real = NDArray[np.float64]
Ints = NDArray[np.int64]


class RectangleSolution(NamedTuple):
    """Coordinates u, v (n,), 0 .. 1 between opposite sides.

    `sides` are the vertices of the lower, right, upper and left side, corners at both ends; `backend` is what solved.
    """

    u: Real
    v: Real
    sides: list[Ints]
    backend: str


def rectangle_sides(loop: Ints, corners: Ints) -> list[Ints]:
    """Vertices from each corner, given by its place, to the next one."""
    ends = np.roll(corners, -1)
    spans = (ends - corners) % len(loop)
    return [
        loop[(start + np.arange(span + 1)) % len(loop)]
        for start, span in zip(corners.tolist(), spans.tolist(), strict=True)
    ]


def solve_rectangle(
    surface: Surface, laplacian: EdgeLaplacian, loop: Ints, corners: Ints, backend: str, progress: Progress
) -> RectangleSolution:
    """Both coordinates for corners at these places of the loop."""
    sides = rectangle_sides(loop, corners)
    low, right, high, left = sides
    u, used = _between(surface, laplacian, left, right, backend, progress)
    v, _ = _between(surface, laplacian, low, high, backend, progress)
    return RectangleSolution(u, v, sides, used)


def _between(
    surface: Surface, laplacian: EdgeLaplacian, zero: Ints, one: Ints, backend: str, progress: Progress
) -> tuple[Real, str]:
    """The function that is 0 on some vertices, 1 on others, and harmonic elsewhere."""
    held = np.concatenate((zero, one))
    problem = DirichletProblem(laplacian, held, surface.n, points=surface.V, backend=backend, progress=progress)
    progress("extension", 0.0)
    values = np.repeat([0.0, 1.0], [len(zero), len(one)]).astype(np.complex128)
    return np.ascontiguousarray(problem.extend(values).real), problem.backend
