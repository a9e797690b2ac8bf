"""The Dirichlet problem of a surface spread over ranks: `operators.DirichletProblem`, interior values in parts."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from ..errors import MeshError
from ..mesh import refusals
from ..operators.laplacian import cotangent_weights
from ..operators.neumann_strip import RINGS
from ..options import DistributedSolver
from .checks import Boundary
from .krylov import TOLERANCE, KrylovSystem
from .part import Part
from .strip import SharedStrip, gathered_strip

__all__ = ["DistributedDirichlet"]

Complex = NDArray[np.complex128]
Ints = NDArray[np.int64]
Real = NDArray[np.float64]

ROUNDING = 1e-14  # a weight above minus this is 0 to rounding


class DistributedDirichlet:
    """``Lii u_i = -Lib u_b`` for the cotangent Laplacian; every rank has u_b, and its own vertices' part of u_i.

    What it offers to Newton's method on the boundary is what `DirichletProblem` does, and collective.

    Attributes
    ----------
    part : Part
    boundary : (nb,) int64
    place : (size,) int64
        Where on the boundary each local vertex is, -1 inside.
    interior : (ni,) int64
        Own vertices, locally numbered, that are interior.
    negative : int
        Interior edges of the surface with a negative weight: it may fold there.
    Lbb : (nb, nb) csr_array
        On every rank.

    Raises
    ------
    DegenerateFaceError
        Faces without area have no cotangents.
    MeshError
        There is no interior vertex.
    """

    def __init__(self, part: Part, boundary: Boundary, solver: DistributedSolver) -> None:
        ranks = part.ranks
        self.part, self.boundary, self.n = part, boundary.loop, part.vertices.count
        bad = ranks.indices(part.face[part.geometry.degenerate])
        if len(bad):
            raise refusals.areas_lost(bad)
        with ranks.agreed():
            self.place = _places(part, boundary.loop)
            self.interior = np.flatnonzero(self.place[: part.own] < 0)
            weights = cotangent_weights(part.edges, part.geometry) if len(part.face) else np.empty(0)
        if int(ranks.total(np.array([len(self.interior)]))[0]) == 0:
            raise MeshError(
                'The surface has no vertex off its boundary; leave out backend="petsc", which is for giant ones.'
            )
        self._weights = weights
        told, _, _ = part.told_edges()
        negative = np.count_nonzero(told & (weights < -ROUNDING) & (part.edges.count == 2))
        self.negative = int(ranks.total(np.array([negative]))[0])
        degree: Real = np.bincount(part.edges.lo, weights, part.size).astype(np.float64, copy=False)
        degree = degree + np.bincount(part.edges.hi, weights, part.size)
        self._blocks(degree)
        self._assemble(degree, solver)

    @property
    def solver(self) -> DistributedSolver:
        """Who solves."""
        return self._system.solver

    @property
    def steps(self) -> list[int]:
        """Iterations of each solution so far."""
        return self._system.steps

    def _assemble(self, degree: Real, solver: DistributedSolver) -> None:
        """Rows of Lii of the own interior vertices."""
        part, ranks = self.part, self.part.ranks
        ni, first = len(self.interior), ranks.before(len(self.interior))
        own = np.full(part.own, -1, dtype=np.int64)
        own[self.interior] = first + np.arange(ni)
        number = part.with_ghosts(own)
        with ranks.agreed():
            inside = number >= 0
            rows, columns, data = [], [], []
            for a, b in ((part.edges.lo, part.edges.hi), (part.edges.hi, part.edges.lo)):
                here = np.flatnonzero((a < part.own) & inside[a] & inside[b])
                rows.append((number[a[here]] - first).astype(np.int32))
                columns.append(number[b[here]])
                data.append(-self._weights[here])
            rows.append(np.arange(ni, dtype=np.int32))
            columns.append(number[self.interior])
            data.append(degree[self.interior])
            row, column, values = np.concatenate(rows), np.concatenate(columns), np.concatenate(data)
            del rows, columns, data
            order = np.lexsort((column, row))
            column, values = column[order], values[order]
            indptr = np.concatenate(([0], np.cumsum(np.bincount(row, minlength=ni))))
            del order, row
        self._system = KrylovSystem(ranks, indptr, column, values, solver)

    def _blocks(self, degree: Real) -> None:
        """Lib of the own interior vertices, and Lbb."""
        part, nb = self.part, len(self.boundary)
        number = np.full(part.own, -1, dtype=np.int64)
        number[self.interior] = np.arange(len(self.interior))
        rows, columns, data, pairs, between = [], [], [], [], []
        for a, b in ((part.edges.lo, part.edges.hi), (part.edges.hi, part.edges.lo)):
            touching = np.flatnonzero((self.place[b] >= 0) & (a < part.own))
            inner = self.place[a[touching]] < 0
            mixed, outer = touching[inner], touching[~inner]
            rows.append(number[a[mixed]])
            columns.append(self.place[b[mixed]])
            data.append(-self._weights[mixed])
            pairs.append(np.column_stack((self.place[a[outer]], self.place[b[outer]])))
            between.append(-self._weights[outer])
        mine = np.flatnonzero(self.place[: part.own] >= 0)
        pairs.append(np.column_stack((self.place[mine], self.place[mine])))
        between.append(degree[mine])
        shape = len(self.interior), nb
        self._lib = csr_array((np.concatenate(data), (np.concatenate(rows), np.concatenate(columns))), shape=shape)
        self._lbi = self._lib.T.tocsr()
        i, j = part.ranks.joined(np.concatenate(pairs)).T
        self.Lbb = csr_array((part.ranks.joined(np.concatenate(between)), (i, j)), shape=(nb, nb))

    @property
    def accuracy(self) -> float:
        """Relative error of a solution."""
        return TOLERANCE

    @cached_property
    def boundary_inverse(self) -> SharedStrip:
        """About the inverse of what `flux` applies to boundary values: the first rank's, for all."""
        return gathered_strip(self.part, self.place, self._weights, self.boundary, RINGS)

    def solve(self, rhs: Real) -> Real:
        """``Lii^-1 rhs`` for the own interior vertices, (ni,)."""
        return self._system.solve(rhs)

    def interior_values(self, zb: Complex) -> Complex:
        """Harmonic extension of boundary values (nb,) at the own interior vertices, (ni,)."""
        zb = self.part.ranks.same(np.array(zb, dtype=np.complex128))
        rhs = -(self._lib @ zb)
        z = np.empty(len(rhs), dtype=np.complex128)
        z.real = self.solve(np.ascontiguousarray(rhs.real))
        z.imag = self.solve(np.ascontiguousarray(rhs.imag))
        return z

    def flux(self, zb: Complex, interior: Complex) -> Complex:
        """Outward flux (nb,) of the extension with these interior values, the same on all ranks."""
        total: Complex = self.part.ranks.total(self._lbi @ interior)
        return self.Lbb @ zb + total

    def measure(self, poles: Real) -> Real:
        """The sum of the harmonic measures (nb,) seen from own interior vertices, each times its pole (ni,)."""
        return np.asarray(-self.part.ranks.total(self._lbi @ self.solve(poles)))

    def extended(self, zb: Complex, interior: Complex) -> Complex:
        """Boundary and interior values at all local vertices."""
        own = np.empty(self.part.own, dtype=np.complex128)
        own[self.interior] = interior
        mine = self.place[: self.part.own]
        own[mine >= 0] = zb[mine[mine >= 0]]
        return self.part.with_ghosts(own)


def _places(part: Part, loop: Ints) -> Ints:
    order = np.argsort(loop)
    names = part.names(np.arange(part.size))
    at = np.minimum(np.searchsorted(loop, names, sorter=order), len(loop) - 1)
    return np.where(loop[order[at]] == names, order[at], -1)
