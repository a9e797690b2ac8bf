"""Boundaries of few vertices: the least shear of all boundary angles, as `disk.relative_energy`, of many disks."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..disk.relative_energy import ROUNDS, SETTLED, area_form
from ..disk.shear_ratio import RatioRows, least_ratios
from ..operators.dirichlet import DirichletProblem
from ..operators.wirtinger import planar_sides, unfolded_sides, wirtinger
from ..optimize import NewtonStep
from ..optimize.rows import row_history
from .boundary_rows import FluxMatrices
from .disks import Disks, places
from .loop_rows import LoopRows, loop_rows

__all__ = ["MEASURES", "ShearAngles", "least_shears"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]
Bools = NDArray[np.bool_]
Complex = NDArray[np.complex128]

MEASURES = 3  # the Laplacian's own energy by the area, the faces' energy by the area, their mean squared shear
MOST_SLOPES = 1 << 20  # that are worked on together
LEAST_SIZE = 1e-12  # of the largest derivative squared


class ShearAngles:
    """What was found by one measure.

    Attributes
    ----------
    theta : (nb,) float64
        The angles of all boundary vertices; those given where nothing was found.
    found : (c,) bool
    """

    def __init__(self, theta: Real, count: int) -> None:
        self.theta, self.found = theta.copy(), np.zeros(count, dtype=bool)
        self._rows: list[tuple[Ints, RatioRows]] = []
        self._where = np.full((count, 2), -1, dtype=np.int64)

    def put(self, rows: LoopRows, made: RatioRows) -> None:
        """The angles of some disks, in place of others of before."""
        self.theta[rows.at] = made.theta
        self.found[rows.disk] = True
        self._where[rows.disk, 0], self._where[rows.disk, 1] = len(self._rows), np.arange(len(rows.disk))
        self._rows.append((rows.disk, made))

    def history(self, disk: int) -> tuple[NewtonStep, ...]:
        """A row for each iterate of the last minimisation, the ratio in the energy's place."""
        which, place = self._where[disk].tolist()
        made = self._rows[which][1]
        if np.isnan(made.value[place]):
            return ()
        return row_history(made.steps, place, made.value[place], made.norm[place])


def least_shears(
    disks: Disks, problem: DirichletProblem, S: FluxMatrices, intrinsic: Bools, theta: Real, chosen: Ints
) -> list[ShearAngles]:
    """Boundary angles of the least shear near those given, of some disks, by each of the measures.

    Parameters
    ----------
    intrinsic : (c,) bool
        Disks whose Laplacian is not that of their own faces; only they have the first measure.
    theta : (nb,) float64
    chosen : (k,) int64, ascending
        Disks of few boundary vertices.
    """
    out = [ShearAngles(theta, len(disks)) for _ in range(MEASURES)]
    if not len(chosen):
        return out
    faces = places(disks.first_face, chosen)
    slopes = _slopes(disks, problem, faces, int(np.diff(disks.first_boundary)[chosen].max()))
    number = np.full(disks.corners.shape[1] + 1, len(faces))
    number[faces] = np.arange(len(faces))
    for rows in loop_rows(disks.first_boundary, chosen):
        for part in _alike(disks, rows):
            _minimise(disks, part, slopes, number, S.of(part), intrinsic, theta, out)
    return out


def _slopes(disks: Disks, problem: DirichletProblem, faces: Ints, most: int) -> Complex:
    """f_z (m + 1, most) of some faces for each boundary vertex of their disk at 1 and all others at 0, the last row 0.

    Two vertices of every disk at a time, as the real and the imaginary part of one function.
    """
    corners = disks.corners[:, faces]
    first, second = (side[faces] for side in unfolded_sides(disks.geometry))
    double_area = disks.geometry.double_area[faces]
    place = np.arange(len(disks.loop)) - disks.first_boundary[disks.of_boundary]
    out = np.zeros((len(faces) + 1, most), dtype=np.complex128)
    for column in range(0, most, 2):
        z = problem.extend((place == column) + 1j * (place == column + 1))
        fz, fzbar = wirtinger((first, second), planar_sides(z, corners), double_area)
        out[:-1, column] = 0.5 * (fz + np.conj(fzbar))
        if column + 1 < most:
            out[:-1, column + 1] = -0.5j * (fz - np.conj(fzbar))
    return out


def _alike(disks: Disks, rows: LoopRows) -> Iterator[LoopRows]:
    """The disks of some rows in groups of about as many faces."""
    count = np.diff(disks.first_face)[rows.disk]
    order = np.argsort(count, kind="stable")
    start = 0
    while start < len(order):
        end = start + 1
        while end < len(order) and end - start < 256 and count[order[end]] <= 1.2 * count[order[start]] + 8:
            end += 1
        part = np.sort(order[start:end])
        yield LoopRows(rows.disk[part], rows.at[part])
        start = end


def _minimise(
    disks: Disks,
    rows: LoopRows,
    slopes: Complex,
    number: Ints,
    S: Real,
    intrinsic: Bools,
    theta: Real,
    out: list[ShearAngles],
) -> None:
    """As `disk.relative_energy.least_shear`, of the disks of some rows."""
    nb = rows.at.shape[1]
    first, count = disks.first_face[rows.disk], np.diff(disks.first_face)[rows.disk]
    place = np.arange(int(count.max()))
    face = np.where(place < count[:, None], first[:, None] + place, len(number) - 1)
    own = slopes[number[face]][:, :, :nb]
    area = np.append(disks.geometry.double_area, 0.0)[face]
    by_area = np.broadcast_to(area_form(nb), (len(face), nb, nb))
    other = np.flatnonzero(intrinsic[rows.disk])
    if len(other):
        flux = 0.5 * (S + S.transpose(0, 2, 1))[other].astype(np.complex128)
        found = least_ratios(flux, by_area[other], theta[rows.at[other]])
        out[0].put(LoopRows(rows.disk[other], rows.at[other]), found)
    weights, angles, left = area, theta[rows.at], np.arange(len(face))
    for round_ in range(ROUNDS):
        here, across = own[left], own[left].conj().transpose(0, 2, 1)
        weighted = here * weights[:, :, None]
        above = weighted.transpose(0, 2, 1) @ here.conj()
        made = least_ratios(above, across @ weighted, angles)
        part = LoopRows(rows.disk[left], rows.at[left])
        if round_ == 0:
            out[1].put(part, made)
        done = np.full(len(left), round_ == ROUNDS - 1)
        if round_:
            done |= np.abs(made.theta - angles).max(axis=1) < SETTLED
            out[2].put(part, made)
        left, angles = left[~done], made.theta[~done]
        if not len(left):
            break
        size = np.abs(own[left] @ np.exp(1j * angles)[:, :, None])[:, :, 0] ** 2
        least = LEAST_SIZE * size.max(axis=1, keepdims=True) + np.finfo(np.float64).tiny
        weights = np.where(area[left] > 0.0, 1.0 / np.maximum(size, least), 0.0)
