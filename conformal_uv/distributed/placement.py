"""Placing a map spread over ranks by a Moebius map of the disk, as `disk.placement` places one in a single array."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ..charts.upright import summed_rises, turns_and_flats
from ..disk.gauge import CentreGauge
from ..disk.placement import CUBE_ROOTS, inside_disk
from ..disk.spacing import with_distinct_boundary
from ..errors import SolverError
from ..operators.moebius import Moebius
from ..operators.orientation_sign import flipped_faces
from ..options import DiskOptions, Upright
from .dirichlet import DistributedDirichlet

__all__ = ["Placement"]

Complex = NDArray[np.complex128]
Ints = NDArray[np.int64]


class Placement:
    """Positions (size,) at the local vertices of a part, those of other ranks' vertices the same as there.

    Parameters
    ----------
    problem : DistributedDirichlet
    zb : (nb,) complex128
        The boundary, on every rank.
    interior : (ni,) complex128
    """

    def __init__(self, problem: DistributedDirichlet, zb: Complex, interior: Complex) -> None:
        self.problem = problem
        self.z = problem.extended(zb, interior)
        self.zb = zb

    def placed(self, options: DiskOptions) -> None:
        """Where the options want it; with_distinct_boundary included."""
        loop = self.problem.boundary
        if options.pins is not None:
            held = np.array([int(np.flatnonzero(loop == pin)[0]) for pin in options.pins])
            self._apart(np.array([0]))  # pins that crowd, too
            self._to_pins(held)
        else:
            first = loop[0] if options.boundary_vertex is None else options.boundary_vertex
            held = np.flatnonzero(loop == first)
            self._to_center(options.center, int(held[0]))
        self._apart(np.sort(held))

    def turned(self, upright: Upright) -> None:
        """What is up on the surface up in the map."""
        if upright is Upright.NONE:
            return
        part, ranks = self.problem.part, self.problem.part.ranks
        origin = next(point for point in ranks.each(part.V[0] if part.own else None) if point is not None)
        size = np.array([ranks.most(float(np.abs(part.V - origin).max(initial=0.0)))])
        F = part.corners.T[part.counted]
        total, rises = np.zeros(1), [np.zeros(1, dtype=np.complex128)] * 2
        if len(F):
            total, rises = summed_rises(part.V - origin, F, self.z, np.zeros(len(F), dtype=np.int64), size, upright)
        (turn,), _ = turns_and_flats(ranks.total(total), [ranks.total(rise) for rise in rises])
        if turn != 1.0:
            self._set(inside_disk(self.z * turn), inside_disk(self.zb * turn))

    def folds(self, z: Complex | None = None) -> int:
        """How many faces of the surface are folded."""
        return int(self.problem.part.ranks.total(np.array([len(self._folded(z))]))[0])

    def flipped(self) -> Ints:
        """The surface's numbers of the folded faces, on every rank."""
        part = self.problem.part
        return part.ranks.indices(part.face[part.counted][self._folded()])

    def value(self, vertex: int) -> complex:
        """Where a vertex of any rank is."""
        part = self.problem.part
        own = part.vertices.first <= vertex < part.vertices.last
        here = self.z[vertex - part.vertices.first] if own else 0.0
        return complex(part.ranks.total(np.array([here], dtype=np.complex128))[0])

    def _folded(self, z: Complex | None = None) -> Ints:
        part = self.problem.part
        return flipped_faces(self.z if z is None else z, part.corners[:, part.counted])

    def _set(self, z: Complex, zb: Complex, fixed: Mapping[int, complex] | None = None) -> None:
        """New positions; `fixed` vertices of the surface at these places exactly."""
        part = self.problem.part
        z, zb = inside_disk(z), inside_disk(zb)
        own = z[: part.own].copy()
        for vertex, value in (fixed or {}).items():
            if part.vertices.first <= vertex < part.vertices.last:
                own[vertex - part.vertices.first] = value
            zb[self.problem.boundary == vertex] = value
        mine = self.problem.place[: part.own]
        own[mine >= 0] = zb[mine[mine >= 0]]
        self.z, self.zb = part.with_ghosts(own), zb

    def _apart(self, held: Ints) -> None:
        """Neighbours on the boundary that had rounded to one point moved apart."""
        distinct = with_distinct_boundary(self.zb, np.arange(len(self.zb)), held)
        if distinct is not self.zb:
            self._set(self.z, distinct)

    def _pointwise(self, moebius: Moebius, fixed: Mapping[int, complex]) -> None:
        zb = moebius(self.zb)
        self._set(moebius(self.z), zb / np.abs(zb), fixed)

    def _extended(self, zb: Complex, fixed: Mapping[int, complex]) -> None:
        problem = self.problem
        self._set(problem.extended(zb, problem.interior_values(zb)), zb, fixed)

    def _to_center(self, center: int | None, first: int) -> None:
        """See `disk.placement.place_center`."""
        problem = self.problem
        p = 0.0 if center is None else self.value(center)
        if not abs(p) < 1.0:
            raise SolverError(
                f"Vertex {center} comes to lie on the circle: seen from there the rest of the surface is too small for "
                "doubles. Choose a center farther from the boundary."
            )
        fixed = {int(problem.boundary[first]): 1.0 + 0.0j}
        if center is not None:
            fixed[center] = 0.0j
        before, theta = (self.folds() if p != 0.0 else 0), np.angle(self.zb)
        self._pointwise(Moebius.to_zero(p, self.zb[first]), fixed)
        if p == 0.0 or center is None or self.folds() <= before:
            return
        measure = problem.measure((problem.part.names(problem.interior) == center).astype(np.float64))
        if measure.max() < 0.5:
            theta = theta[0] + np.concatenate(([0.0], np.cumsum(np.mod(np.diff(theta), 2.0 * np.pi))))
            theta = CentreGauge(measure, theta).restore(theta)
            self._extended(np.exp(1j * (theta - theta[first])), fixed)

    def _to_pins(self, held: Ints) -> None:
        """See `disk.placement.place_pins`."""
        before = self.folds()
        fixed = dict(zip(self.problem.boundary[held].tolist(), CUBE_ROOTS.tolist(), strict=True))
        self._pointwise(Moebius.from_three_pairs(self.zb[held], CUBE_ROOTS), fixed)
        folds = self.folds()
        if folds > before:
            z, zb = self.z, self.zb
            self._extended(zb, fixed)
            if self.folds() >= folds:
                self.z, self.zb = z, zb
