"""Placing a disk map by a Moebius map of the disk: a vertex at 0 and one at 1, or three pins."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import SolverError
from ..operators.dirichlet import DirichletProblem
from ..operators.moebius import Moebius
from ..operators.wirtinger import planar_sides, signed_double_areas

__all__ = ["CUBE_ROOTS", "place_center", "place_pins"]

Complex = NDArray[np.complex128]

CUBE_ROOTS = np.exp(2j * np.pi / 3.0 * np.arange(3))
CUBE_ROOTS[0] = 1.0


def place_center(
    problem: DirichletProblem, corners: NDArray[np.int32], z: Complex, center: int | None, boundary_vertex: int
) -> Complex:
    """The map with `center` (None: what is at 0 now) at 0 and the boundary vertex at 1."""
    p = 0.0 if center is None else complex(z[center])
    if not abs(p) < 1.0:
        raise SolverError(
            f"Vertex {center} comes to lie on the circle: seen from there the rest of the surface is too small for "
            "doubles. Choose a center farther from the boundary."
        )
    placed = _moved(problem, corners, z, Moebius.to_zero(p, z[boundary_vertex]))
    if center is not None:
        # Where harmonic extension had to replace the moved interior, the centre is off by a little.
        for _ in range(20):
            if abs(placed[center]) < 1e-14:
                break
            step = Moebius.to_zero(complex(placed[center]), placed[boundary_vertex])
            placed = problem.extend(_on_circle(step(placed[problem.boundary])))
        placed[center] = 0.0
    placed[boundary_vertex] = 1.0
    return placed


def place_pins(
    problem: DirichletProblem, corners: NDArray[np.int32], z: Complex, pins: tuple[int, int, int]
) -> Complex:
    """The map with the three pins at the cube roots of unity."""
    at = list(pins)
    placed = _moved(problem, corners, z, Moebius.from_three_pairs(z[at], CUBE_ROOTS))
    placed[at] = CUBE_ROOTS
    return placed


def _moved(
    problem: DirichletProblem, corners: NDArray[np.int32], z: Complex, moebius: Moebius
) -> Complex:
    """z after a map of the disk onto itself, vertex by vertex.

    Straight edges stand in for the arcs to which the map bends them, so large triangles can fold where it
    shrinks strongly; then the boundary alone is moved and extended harmonically.
    """
    moved = moebius(z)
    moved[problem.boundary] = _on_circle(moved[problem.boundary])
    rotation = abs(moebius.b) == 0.0 and abs(moebius.c) == 0.0
    if rotation or _flips(moved, corners) <= _flips(z, corners):
        return moved
    extended = problem.extend(moved[problem.boundary])
    return extended if _flips(extended, corners) < _flips(moved, corners) else moved


def _on_circle(zb: Complex) -> Complex:
    return zb / np.abs(zb)


def _flips(z: Complex, corners: NDArray[np.int32]) -> int:
    return int(np.count_nonzero(signed_double_areas(planar_sides(z, corners)) <= 0.0))
