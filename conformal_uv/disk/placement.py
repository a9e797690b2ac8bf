"""Placing a disk map by a Moebius map of the disk: a vertex at 0 and one at 1, or three pins."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ..errors import SolverError
from ..operators.dirichlet import DirichletProblem
from ..operators.moebius import Moebius
from ..operators.orientation_sign import flipped_faces
from .gauge import CentreGauge

__all__ = ["CUBE_ROOTS", "inside_disk", "place_balanced", "place_center", "place_pins"]

Complex = NDArray[np.complex128]

CUBE_ROOTS = np.exp(2j * np.pi / 3.0 * np.arange(3))
CUBE_ROOTS[0] = 1.0


def inside_disk(z: Complex) -> Complex:
    """z with what rounding, large in an ill-conditioned solution, has put outside the disk back on the circle."""
    size = np.abs(z)
    return z / np.maximum(size, 1.0) if size.max(initial=0.0) > 1.0 else z


def place_center(
    problem: DirichletProblem, corners: NDArray[np.int32], z: Complex, center: int | None, boundary_vertex: int
) -> tuple[Complex, NDArray[np.int64]]:
    """The map with `center` (None: what is at 0 now) at 0 and the boundary vertex at 1, and the faces folded there."""
    p = 0.0 if center is None else complex(z[center])
    if not abs(p) < 1.0:
        raise SolverError(
            f"Vertex {center} comes to lie on the circle: seen from there the rest of the surface is too small for "
            "doubles. Choose a center farther from the boundary."
        )
    fixed = {boundary_vertex: 1.0} if center is None else {center: 0.0, boundary_vertex: 1.0}
    placed = _fixed(_pointwise(problem, z, Moebius.to_zero(p, z[boundary_vertex])), fixed)
    folds = flipped_faces(placed, corners)
    if p != 0.0 and center is not None and len(folds) and len(folds) > len(flipped_faces(z, corners)):
        placed = _fixed(_extended_about(problem, z, placed, center, boundary_vertex), fixed)
        folds = flipped_faces(placed, corners)
    return placed, folds


def place_balanced(
    problem: DirichletProblem, corners: NDArray[np.int32], z: Complex, point: complex, boundary_vertex: int
) -> tuple[Complex, NDArray[np.int64]]:
    """The map with `point` at 0, extended anew from its boundary, and the boundary vertex at 1; the faces folded there.

    Where more would be folded than are, the map is only turned.
    """
    turned, folds = place_center(problem, corners, z, None, boundary_vertex)
    moved = _on_circle(Moebius.to_zero(point, z[boundary_vertex])(z[problem.boundary]))
    placed = _fixed(problem.extend(moved), {boundary_vertex: 1.0})
    left = flipped_faces(placed, corners)
    return (placed, left) if len(left) <= len(folds) else (turned, folds)


def place_pins(
    problem: DirichletProblem, corners: NDArray[np.int32], z: Complex, pins: tuple[int, int, int]
) -> tuple[Complex, NDArray[np.int64]]:
    """The map with the three pins at the cube roots of unity, and the faces folded there."""
    at = list(pins)
    fixed = dict(zip(at, CUBE_ROOTS, strict=True))
    placed = _fixed(_pointwise(problem, z, Moebius.from_three_pairs(z[at], CUBE_ROOTS)), fixed)
    folds = flipped_faces(placed, corners)
    if len(folds) and len(folds) > len(flipped_faces(z, corners)):
        extended = _fixed(problem.extend(placed[problem.boundary]), fixed)
        fewer = flipped_faces(extended, corners)
        if len(fewer) < len(folds):
            return extended, fewer
    return placed, folds


def _fixed(z: Complex, places: Mapping[int, complex]) -> Complex:
    """z within the disk, some vertices exactly at their places."""
    z = inside_disk(z)
    z[list(places)] = list(places.values())
    return z


def _pointwise(problem: DirichletProblem, z: Complex, moebius: Moebius) -> Complex:
    """z after a map of the disk onto itself, vertex by vertex.

    Straight edges stand in for the arcs to which the map bends them, so large triangles can fold where it shrinks
    strongly. The harmonic extension of the moved boundary is the other way, and needs two back-substitutions.
    """
    moved = moebius(z)
    moved[problem.boundary] = _on_circle(moved[problem.boundary])
    return moved


def _extended_about(
    problem: DirichletProblem, z: Complex, placed: Complex, center: int, boundary_vertex: int
) -> Complex:
    """The harmonic extension of the boundary moved so that the center's mean of it, by harmonic measure, is 0.

    Where one boundary vertex has half the measure or more no map of the disk brings the mean to 0; then it is
    `placed`, the map moved vertex by vertex.
    """
    measure = problem.harmonic_measure(center)
    if measure.max() >= 0.5:
        return placed
    theta = np.angle(z[problem.boundary])
    theta = theta[0] + np.concatenate(([0.0], np.cumsum(np.mod(np.diff(theta), 2.0 * np.pi))))
    theta = CentreGauge(measure, theta).restore(theta)
    first = int(np.flatnonzero(problem.boundary == boundary_vertex)[0])
    return problem.extend(np.exp(1j * (theta - theta[first])))


def _on_circle(zb: Complex) -> Complex:
    return zb / np.abs(zb)
