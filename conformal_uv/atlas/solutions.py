"""The linear and Newton's solutions of many disks, before they are placed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..disk.centre_cell import WORTH_WHILE
from ..operators.dirichlet import DirichletProblem
from ..optimize import NewtonStep
from ..optimize.rows import RowStep, row_history
from ..options import DiskOptions
from ..threads import side_by_side
from .boundary_rows import EnergyRows, FluxMatrices, centred_rows
from .disks import Disks
from .loop_rows import LoopRows, loop_rows
from .measures import Measures
from .newton_rows import NewtonRows, minimised_rows

__all__ = ["NewtonSolver", "linear_positions"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]
Bools = NDArray[np.bool_]
Complex = NDArray[np.complex128]


def linear_positions(disks: Disks, problem: DirichletProblem, seen: Measures) -> Complex:
    """Positions of all vertices (n,): angles from the harmonic measures, harmonically extended."""
    theta = seen.theta.copy()
    for rows in loop_rows(disks.first_boundary, np.flatnonzero(seen.found)):
        theta[rows.at] = centred_rows(seen.theta[rows.at], seen.vertex_measure[rows.at])
    return problem.extend(np.exp(1j * theta))


class NewtonSolver:
    """Newton's solutions of c disks, from the linear ones.

    Attributes
    ----------
    z : (n,) complex128
        Positions of all vertices.
    converged : (c,) bool
        What is told of the others means nothing.
    S : FluxMatrices
    theta : (nb,) float64
        Angles of all boundary vertices.
    """

    def __init__(self, disks: Disks, problem: DirichletProblem, seen: Measures, options: DiskOptions) -> None:
        count = len(disks)
        self._disks, self._seen, self._options = disks, seen, options
        self.S = FluxMatrices(problem, disks.first_boundary)
        self.theta, self._rounds = seen.theta.copy(), list[RowStep]()
        self.converged = np.zeros(count, dtype=bool)
        self._value, self._norm, self._first = np.full((3, count), np.nan)
        self._minimise(np.flatnonzero(seen.found), options.tolerance, held=True)
        self.z = problem.extend(np.exp(1j * self.theta))
        free = self._worth_releasing()
        if len(free):
            self._release(free)
            self.z = problem.extend(np.exp(1j * self.theta))

    def history(self, disk: int) -> tuple[NewtonStep, ...]:
        """A row for each iterate; directions are solved for without conjugate gradients."""
        return row_history(self._rounds, disk, self._value[disk], self._norm[disk])

    def _minimise(self, chosen: Ints, tolerance: Real | float, *, held: bool) -> None:
        """Of the chosen disks, from where they are; `tolerance` is of all disks or of each (c,)."""
        groups = list(loop_rows(self._disks.first_boundary, chosen))
        solved = side_by_side(lambda rows: self._minimised(rows, tolerance, held=held), groups)
        for rows, found in zip(groups, solved, strict=True):
            self.theta[rows.at] = found.theta
            self.converged[rows.disk] = found.converged
            self._value[rows.disk], self._norm[rows.disk] = found.value, found.norm
            if held:
                self._first[rows.disk] = found.first
            self._rounds += [RowStep(rows.disk[step.row], step.value, step.norm, step.length) for step in found.steps]

    def _minimised(self, rows: LoopRows, tolerance: Real | float, *, held: bool) -> NewtonRows:
        return minimised_rows(
            self.S.of(rows),
            self.theta[rows.at],
            self._seen.vertex_measure[rows.at],
            held=held,
            tolerance=tolerance if isinstance(tolerance, float) else tolerance[rows.disk],
            relative_tolerance=self._options.relative_tolerance if held else 0.0,
            max_iterations=self._options.max_iterations,
        )

    def _worth_releasing(self) -> Ints:
        """Disks whose centres may be released, as `disk.centre_cell` decides."""
        reach = self._reach()
        found = [np.empty(0, dtype=np.int64)]
        for rows in loop_rows(self._disks.first_boundary, np.flatnonzero(self.converged & (reach > 0.0))):
            energy = EnergyRows(self.S.of(rows), self.theta[rows.at])
            moves, worth, far = energy.moebius_moves(), WORTH_WHILE * energy.value, reach[rows.disk]
            slope = np.einsum("rkc,rk->rc", moves, energy.gradient)
            some = 0.5 * np.linalg.norm(slope, axis=1) * far >= worth
            moves, slope, worth, far = moves[some], slope[some], worth[some], far[some]
            curvature = moves.transpose(0, 2, 1) @ energy.some(some).hessian() @ moves
            convex = np.linalg.eigvalsh(curvature)[:, 0] > 0.0
            step = np.linalg.solve(np.where(convex[:, None, None], curvature, np.eye(2)), slope[:, :, None])[:, :, 0]
            gain = 0.5 * np.einsum("rc,rc->r", slope, step)
            worthy = convex & (np.linalg.norm(step, axis=1) < far) & (gain >= worth)
            found.append(rows.disk[some][worthy])
        return np.sort(np.concatenate(found))

    def _reach(self) -> Real:
        """Distance (c,) of the farthest neighbour of each centre from it; 0 where there is no centre."""
        disks, centre = self._disks, self._seen.centre
        lo, hi = disks.edges.lo, disks.edges.hi
        of_edge = disks.of_vertex[lo]
        at = np.flatnonzero((centre[of_edge] == lo) | (centre[of_edge] == hi))
        reach = np.zeros(len(disks))
        np.maximum.at(reach, of_edge[at], np.abs(self.z[lo[at]] - self.z[hi[at]]))
        return reach

    def _release(self, free: Ints) -> None:
        """Minimise without holding the centres, where that keeps them in their cells."""
        theta, value, norm, made_before = self.theta.copy(), self._value.copy(), self._norm.copy(), len(self._rounds)
        reach = self._reach()
        least = np.full(len(self._disks), self._options.tolerance)
        np.fmax(least, self._options.relative_tolerance * self._first, out=least)
        self._minimise(free, least, held=False)
        for rows in loop_rows(self._disks.first_boundary, free):
            mean = np.einsum("rk,rk->r", self._seen.vertex_measure[rows.at], np.exp(1j * self.theta[rows.at]))
            back = (np.abs(mean) >= reach[rows.disk]) & self.converged[rows.disk]
            gone = rows.disk[back]
            self.theta[rows.at[back]] = theta[rows.at[back]]
            self._value[gone], self._norm[gone] = value[gone], norm[gone]
            for number in range(made_before, len(self._rounds)):
                made = self._rounds[number]
                stay = ~np.isin(made.row, gone)
                self._rounds[number] = RowStep(made.row[stay], made.value[stay], made.norm[stay], made.length[stay])
