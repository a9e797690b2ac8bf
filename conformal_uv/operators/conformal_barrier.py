"""An energy of plane maps that is 0 where angles are kept and infinite where a face folds.

``sum 2 |q|^2 / D`` over the faces, p = f_z, q = f_zbar, D = |p|^2 - |q|^2 the area scale: half of ``K + 1 / K - 2``, K
the ratio of the singular values. Every face counts the same, as in the mean angle error, whatever its size.

Maps that fold have an energy too, where the barrier is softened: ``sum (|p|^2 + |q|^2) / x - 1``, x(D) positive and
the same as D without softening (V. Garanzha et al., "Foldover-free maps in 50 lines of code", 2021, eq. 2).
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array, diags_array

from ..linear.backends import linear_solver
from ..linear.linear_system import LowerTriangle
from ..linear.nested_dissection import nested_dissection
from ..mesh.geometry import TriangleGeometry
from ..mesh.surface import Surface
from .wirtinger import unfolded_sides

__all__ = ["BarrierPlace", "FaceDerivatives", "HeldHessian"]

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]


SHIFT = 1e-12  # of the diagonal, with which slivers do not make it singular


class FaceDerivatives:
    """``p = P z`` and ``q = Q z`` of some faces of a surface, all with area, as sparse matrices.

    Parameters
    ----------
    surface : Surface
    faces : (f,) int64
    vertices : (k,) int64, ascending, optional
        Those whose positions z are, all that the faces have among them; by default all of the surface.
    """

    def __init__(self, surface: Surface, faces: NDArray[np.int64], vertices: NDArray[np.int64] | None = None) -> None:
        corners = surface.corners.take(faces, axis=1)
        geometry = TriangleGeometry(surface.geometry.dot.take(faces, axis=1), surface.geometry.double_area.take(faces))
        first, second = unfolded_sides(geometry)
        opposite = np.stack((second - first, -second, first)) / (2.0 * geometry.double_area)
        columns = corners.reshape(-1) if vertices is None else np.searchsorted(vertices, corners.reshape(-1))
        places = np.tile(np.arange(len(faces)), 3), columns
        shape = len(faces), surface.n if vertices is None else len(vertices)
        self.P = csr_array(((-1j * opposite.conj()).reshape(-1), places), shape=shape)
        self.Q = csr_array(((1j * opposite).reshape(-1), places), shape=shape)
        self.Pt, self.Qt = self.P.conj().T.tocsr(), self.Q.conj().T.tocsr()


class BarrierPlace:
    """The energy at positions z (n,), as a function of the coordinates of the free vertices (k,) alone, (2 k,).

    `softness` is the D below which the barrier is soft; with 0 it is none.
    """

    def __init__(self, faces: FaceDerivatives, free: NDArray[np.int64], z: Complex, softness: float = 0.0) -> None:
        self.z, self.softness = z, softness
        self._faces, self._free = faces, free
        self._p, self._q = faces.P @ z, faces.Q @ z
        self._q2 = np.abs(self._q) ** 2
        self.jacobian = np.abs(self._p) ** 2 - self._q2
        self._root = np.hypot(self.jacobian, softness)
        away = self._root + np.abs(self.jacobian)
        self._soft = 0.5 * np.where(self.jacobian > 0.0, away, softness**2 / np.where(away > 0.0, away, 1.0))

    @property
    def finite(self) -> bool:
        """Whether no face is folded, or folds are allowed."""
        return bool((self._soft > 0.0).all())

    @cached_property
    def value(self) -> float:
        """The energy."""
        return float(((2.0 * self._q2 - self.softness**2 / (4.0 * self._soft)) / self._soft).sum())

    @cached_property
    def gradient(self) -> Real:
        """Its gradient in the coordinates of the free vertices, (2 k,)."""
        size = self.jacobian + 2.0 * self._q2
        factor = 2.0 / (self._soft * self._root)
        by_q, by_p = factor * (self._root + size) * self._q, factor * (size - self._root) * self._p
        full: Complex = self._faces.Qt @ by_q - self._faces.Pt @ by_p
        return full[self._free].view(np.float64)

    def room(self, direction: Real) -> float:
        """Length of the step at which the first face loses its area, where that must not be: roots of quadratics.

        J. Smith, S. Schaefer, "Bijective parameterization with free boundaries", 2015, section 3.3.
        """
        if self.softness > 0.0:
            return float("inf")
        step = self._spread(direction)
        dp, dq = self._faces.P @ step, self._faces.Q @ step
        square = np.abs(dp) ** 2 - np.abs(dq) ** 2
        half = (self._p.conj() * dp).real - (self._q.conj() * dq).real
        root = np.sqrt(np.maximum(half**2 - square * self.jacobian, 0.0))
        meets = (half**2 >= square * self.jacobian) & (root > half)
        # The smaller positive root, without cancellation.
        return float((self.jacobian[meets] / (root - half)[meets]).min(initial=np.inf))

    def moved(self, step: Real) -> BarrierPlace | None:
        """The place after a step; None where a face is folded there that must not be."""
        there = BarrierPlace(self._faces, self._free, self.z + self._spread(step), self.softness)
        return there if there.finite else None

    def softened(self, softness: float) -> BarrierPlace:
        """The same positions with another barrier."""
        return BarrierPlace(self._faces, self._free, self.z, softness)

    def _spread(self, step: Real) -> Complex:
        out = np.zeros(len(self.z), dtype=np.complex128)
        out[self._free] = np.ascontiguousarray(step).view(np.complex128)
        return out

    def held_hessian(self, points: Real, backend: str) -> HeldHessian:
        """That of the conformal energy with each face over its |p|^2, of the free vertices at these points (k, 3)."""
        weights = 4.0 / (self._soft + self._q2)
        return HeldHessian(self._faces.Q[:, self._free], weights, points, backend)


class HeldHessian:
    """``Q* diag(w) Q`` factorized, a Hermitian matrix as a real one of twice its order."""

    def __init__(self, Q: csr_array, weights: Real, points: Real, backend: str) -> None:
        matrix = coo_array(Q.conj().T @ diags_array(weights) @ Q)
        matrix.data[matrix.row == matrix.col] *= 1.0 + SHIFT
        kept = matrix.row >= matrix.col
        i, j, value = 2 * matrix.row[kept], 2 * matrix.col[kept], matrix.data[kept]
        off = i > j
        rows = np.concatenate((i, i + 1, i + 1, i[off]))
        columns = np.concatenate((j, j + 1, j, j[off] + 1))
        values = np.concatenate((value.real, value.real, value.imag, -value.imag[off]))
        lower = csr_array((values, (columns, rows)), shape=(2 * Q.shape[1],) * 2)
        lower.sort_indices()
        pattern = csr_array((value, (j // 2, i // 2)), shape=(Q.shape[1],) * 2)
        pattern.sort_indices()
        order = nested_dissection(points, pattern.indices.astype(np.int32), pattern.indptr)
        if order is not None:
            order = (2 * order[:, None] + np.arange(2, dtype=np.int32)).reshape(-1)
        system = LowerTriangle(lower.data, lower.indices.astype(np.int32), lower.indptr.astype(np.int64), passing=True)
        self._solver = linear_solver(system, backend, order=order)

    def solve(self, gradient: Real) -> Real:
        """The inverse applied to a gradient (2 k,)."""
        return self._solver.solve(gradient)
