"""The report's own algorithm: augmented Lagrangian with Newton's method, all unknowns at once.

C. P. Choi, "Conformal parameterization of a surface", sections 3-4 and the code of its appendix, which settles
what the text leaves open: minimise ``1/2 x' Q x`` over x = (u, v), Q = blkdiag(C, C) with the cotangent weights not
halved, subject to ``1/2 (u_k^2 + v_k^2 - 1) = 0`` on the boundary and ``A x = b`` at three pins.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import block_diag, csc_array, csr_array, diags_array
from scipy.sparse.linalg import SuperLU, splu

from ..errors import SolverError
from ..optimize.line_search import SUFFICIENT_DECREASE

__all__ = ["CircleProblem", "area_hessian", "circle_problem"]

Real = NDArray[np.float64]

MOST_NEWTON_STEPS = 20


@dataclass(frozen=True, eq=False)
class CircleProblem:
    """Quadratic objective, circle constraints on `boundary`, targets for three `pins`.

    Attributes
    ----------
    Q : (2 n, 2 n) csc_array
    boundary : (nb,) vertices
    pins : (3,) vertices
    targets : (6,) float64
        u of the three pins, then v.
    """

    Q: csc_array
    boundary: NDArray[np.int64]
    pins: NDArray[np.int64]
    targets: Real

    @property
    def n(self) -> int:
        """Number of vertices."""
        return self.Q.shape[0] // 2

    @property
    def pinned(self) -> NDArray[np.int64]:
        """Places of the pins' coordinates in x, (6,)."""
        return np.concatenate((self.pins, self.pins + self.n))

    def constraints(self, x: Real) -> Real:
        """c(x): a row for each boundary vertex, then six for the pins."""
        u, v = x[self.boundary], x[self.boundary + self.n]
        return np.concatenate((0.5 * (u * u + v * v - 1.0), x[self.pinned] - self.targets))

    def pull_back(self, x: Real, y: Real) -> Real:
        """``[grad c(x)] y``."""
        circle, pins = y[:-6], y[-6:]
        out = np.zeros_like(x)
        out[self.boundary] = x[self.boundary] * circle
        out[self.boundary + self.n] = x[self.boundary + self.n] * circle
        out[self.pinned] += pins
        return out

    def value(self, x: Real, y: Real, rho: float) -> float:
        """Augmented Lagrangian."""
        c = self.constraints(x)
        return float(0.5 * x @ (self.Q @ x) - y @ c + 0.5 * rho * c @ c)

    def gradient(self, x: Real, y: Real, rho: float) -> Real:
        """Its gradient."""
        return self.Q @ x + self.pull_back(x, rho * self.constraints(x) - y)

    def hessian(self, x: Real, y: Real, rho: float) -> csc_array:
        """Its Hessian: Q, a 2 x 2 block for each boundary vertex, rho at the pins."""
        n, b = self.n, self.boundary
        u, v = x[b], x[b + n]
        bend = (rho * self.constraints(x) - y)[:-6]
        diagonal = np.zeros(2 * n)
        diagonal[b] = bend + rho * u * u
        diagonal[b + n] = bend + rho * v * v
        diagonal[self.pinned] += rho
        mixed = np.zeros(n)
        mixed[b] = rho * u * v
        return csc_array(self.Q + diags_array([mixed, diagonal, mixed], offsets=[-n, 0, n]))

    def kkt_residual(self, x: Real, y: Real) -> float:
        """Norm of the gradient of the objective less the pulled back multipliers."""
        return float(np.linalg.norm(self.Q @ x - self.pull_back(x, y)))

    def minimised(self, x: Real, y: Real, rho: float, tolerance: float) -> Real:
        """Newton's method with backtracking on the augmented Lagrangian in x.

        Raises
        ------
        SolverError
            A Newton system is singular.
        """
        for _ in range(MOST_NEWTON_STEPS):
            gradient = self.gradient(x, y, rho)
            if np.linalg.norm(gradient) < tolerance:
                break
            try:
                step = _factorized(self.hessian(x, y, rho)).solve(-gradient)
            except RuntimeError as error:
                raise SolverError(
                    f"An inner Newton system of the augmented Lagrangian is singular ({error})."
                ) from error
            x = self._backtrack(x, y, rho, step, float(gradient @ step))
        return x

    def _backtrack(self, x: Real, y: Real, rho: float, step: Real, slope: float) -> Real:
        """The longest of the steps 1, 1/2, 1/4 ... that lowers the augmented Lagrangian enough.

        A Newton step that points uphill, or for which rounding leaves no decrease to see, is taken whole.
        """
        here = self.value(x, y, rho)
        if slope < 0.0:
            length = 1.0
            for _ in range(30):
                if self.value(x + length * step, y, rho) <= here + SUFFICIENT_DECREASE * length * slope:
                    return x + length * step
                length *= 0.5
        return x + step


def circle_problem(
    C: csr_array, boundary: NDArray[np.int64], pins: NDArray[np.int64], *, area: csr_array | None = None
) -> CircleProblem:
    """The report's problem over x = (u, v).

    Parameters
    ----------
    C : (n, n) csr_array
        Cotangent Laplacian with weights cot a + cot b.
    boundary : (nb,) integers
        The boundary loop.
    pins : (3,) integers
        Boundary vertices sent to 1, w, w^2 with w = exp(2 pi i / 3).
    area : (2 n, 2 n) csr_array, optional
        Taken off Q; with the Hessian of twice the image's area the objective is the conformal energy.
    """
    third = 2.0 * np.pi / 3.0 * np.arange(3)
    Q = csc_array(block_diag((C, C), format="csc"))
    targets = np.concatenate((np.cos(third), np.sin(third)))
    return CircleProblem(Q if area is None else csc_array(Q - area), boundary, pins, targets)


def _factorized(hessian: csc_array) -> SuperLU:
    """LU factors with pivoting for size in an ordering for a symmetric pattern."""
    return splu(hessian, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})


def area_hessian(boundary: NDArray[np.int64], n: int) -> csr_array:
    """Hessian in x = (u, v) of twice the area inside the boundary polygon, sum u_k v_(k+1) - u_(k+1) v_k."""
    here, there = boundary, np.roll(boundary, -1)
    rows = np.concatenate((here, there))
    columns = np.concatenate((there, here))
    values = np.repeat([1.0, -1.0], len(boundary))
    half = csr_array((values, (rows, columns + n)), shape=(2 * n, 2 * n))
    return csr_array(half + half.T)
