"""The report's own algorithm: augmented Lagrangian with Newton's method, all unknowns at once.

C. P. Choi, "Conformal parameterization of a surface", sections 3-4 and the code of its appendix, which settles
what the text leaves open: minimise ``1/2 x' Q x`` over x = (u, v), Q = blkdiag(C, C) with the cotangent weights not
halved, subject to ``1/2 (u_k^2 + v_k^2 - 1) = 0`` on the boundary and ``A x = b`` at three pins.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import block_diag, csc_array, csr_array, diags_array
from scipy.sparse.linalg import SuperLU, splu

from ..errors import SolverError
from ..progress import Progress

__all__ = ["AugmentedLagrangianResult", "AugmentedLagrangianStep", "area_hessian", "augmented_lagrangian"]

Real = NDArray[np.float64]

FIRST_PENALTY = 10.0
MOST_NEWTON_STEPS = 20
STOP = 1e-8  # for both norms
SUFFICIENT_DECREASE = 1e-4  # Armijo's constant of the backtracking


class AugmentedLagrangianStep(NamedTuple):
    """A row of the report's table: penalty, norm of the constraints, norm of the KKT residual.

    The KKT residual is that of the iterate and the multipliers from before this row's minimisation.
    """

    rho: float
    constraint_norm: float
    kkt_norm: float


class AugmentedLagrangianResult(NamedTuple):
    """Positions uv (n, 2), the rows of the table, and whether both norms fell below 1e-8."""

    uv: Real
    history: tuple[AugmentedLagrangianStep, ...]
    converged: bool


@dataclass(frozen=True, eq=False)
class ConstrainedProblem:
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


def augmented_lagrangian(
    C: csr_array,
    start: Real,
    boundary: NDArray[np.int64],
    pins: NDArray[np.int64],
    *,
    area: csr_array | None = None,
    max_iterations: int = 50,
    progress: Progress | None = None,
) -> AugmentedLagrangianResult:
    """Run the report's algorithm.

    Parameters
    ----------
    C : (n, n) csr_array
        Cotangent Laplacian with weights cot a + cot b.
    start : (n, 2) float64
        First iterate, in the report Tutte's embedding.
    boundary : (nb,) integers
        The boundary loop.
    pins : (3,) integers
        Boundary vertices sent to 1, w, w^2 with w = exp(2 pi i / 3).
    area : (2 n, 2 n) csr_array, optional
        Taken off Q; with the Hessian of twice the image's area the objective is the conformal energy.

    Raises
    ------
    SolverError
        An inner Newton system is singular.
    """
    progress = progress or Progress()
    third = 2.0 * np.pi / 3.0 * np.arange(3)
    Q = csc_array(block_diag((C, C), format="csc"))
    problem = ConstrainedProblem(
        Q if area is None else csc_array(Q - area), boundary, pins, np.concatenate((np.cos(third), np.sin(third)))
    )
    x = np.concatenate((start[:, 0], start[:, 1]))
    y = np.zeros(len(boundary) + 6)
    rho, updates = FIRST_PENALTY, 0
    history: list[AugmentedLagrangianStep] = []
    converged = False
    for iteration in range(1, max_iterations + 1):
        before = x
        x = _minimise(problem, before, y, rho, 1e-4 / 10.0**iteration)
        c = problem.constraints(x)
        norm = float(np.linalg.norm(c))
        history.append(AugmentedLagrangianStep(rho, norm, _kkt(problem, before, y)))
        progress("augmented lagrangian", float(np.clip(np.log(max(norm, STOP)) / np.log(STOP), 0.0, 1.0)))
        if norm < 1e-3 / 2.0**updates:
            y = y - rho * c
            updates += 1
        else:
            rho *= 2.0
        if norm < STOP and _kkt(problem, x, y) < STOP:
            converged = True
            break
    return AugmentedLagrangianResult(x.reshape(2, -1).T.copy(), tuple(history), converged)


def _kkt(problem: ConstrainedProblem, x: Real, y: Real) -> float:
    return float(np.linalg.norm(problem.Q @ x - problem.pull_back(x, y)))


def _minimise(problem: ConstrainedProblem, x: Real, y: Real, rho: float, tolerance: float) -> Real:
    """Newton's method with backtracking on the augmented Lagrangian in x."""
    for _ in range(MOST_NEWTON_STEPS):
        gradient = problem.gradient(x, y, rho)
        if np.linalg.norm(gradient) < tolerance:
            break
        try:
            step = _factorized(problem.hessian(x, y, rho)).solve(-gradient)
        except RuntimeError as error:
            raise SolverError(f"An inner Newton system of the augmented Lagrangian is singular ({error}).") from error
        x = _backtrack(problem, x, y, rho, step, float(gradient @ step))
    return x


def _factorized(hessian: csc_array) -> SuperLU:
    """LU factors with pivoting for size in an ordering for a symmetric pattern."""
    return splu(hessian, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})


def _backtrack(problem: ConstrainedProblem, x: Real, y: Real, rho: float, step: Real, slope: float) -> Real:
    """The longest of the steps 1, 1/2, 1/4 ... that lowers the augmented Lagrangian enough.

    A Newton step that points uphill, or for which rounding leaves no decrease to see, is taken whole.
    """
    here = problem.value(x, y, rho)
    if slope < 0.0:
        length = 1.0
        for _ in range(30):
            if problem.value(x + length * step, y, rho) <= here + SUFFICIENT_DECREASE * length * slope:
                return x + length * step
            length *= 0.5
    return x + step


def area_hessian(boundary: NDArray[np.int64], n: int) -> csr_array:
    """Hessian in x = (u, v) of twice the area inside the boundary polygon, sum u_k v_(k+1) - u_(k+1) v_k."""
    here, there = boundary, np.roll(boundary, -1)
    rows = np.concatenate((here, there))
    columns = np.concatenate((there, here))
    values = np.repeat([1.0, -1.0], len(boundary))
    half = csr_array((values, (rows, columns + n)), shape=(2 * n, 2 * n))
    return csr_array(half + half.T)
