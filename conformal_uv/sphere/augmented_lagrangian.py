"""The sphere map in the report's own way: constraints by an augmented Lagrangian, all coordinates free in space.

C. P. Choi's report, section 6, leaves the sphere as further work. Here its method with constraints of the same kind:
``1/2 (|x_i|^2 - 1) = 0`` for every vertex, and the centre of mass at 0, which holds the Moebius freedom that pins held
in the disk. Slower than Newton's method on the sphere, and independent of it: each is the other's oracle.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from ..disk.augmented_lagrangian import AugmentedLagrangianStep
from ..operators.edge_laplacian import EdgeLaplacian
from ..progress import Progress
from .centring import unit
from .energy import area_gradient, area_hessian_product, laplace, triangle_normals

__all__ = ["SphereConstraints", "augmented_lagrangian_sphere"]

Real = NDArray[np.float64]

FIRST_PENALTY = 10.0
STOP = 1e-8  # for both norms, as in the report
INNER_STEPS = 200


class SphereConstraints:
    """The energy of free positions, and the constraints.

    Parameters
    ----------
    laplacian : EdgeLaplacian
    corners : (3, m) int32
    mass : (n,) float64
        Sum 1.
    """

    def __init__(self, laplacian: EdgeLaplacian, corners: NDArray[np.int32], mass: Real) -> None:
        self.laplacian, self.corners, self.mass = laplacian, corners, mass

    def constraints(self, x: Real) -> Real:
        """c(x): one row for each vertex, three for the centre of mass, (n + 3,)."""
        return np.concatenate((0.5 * (np.einsum("ij,ij->i", x, x) - 1.0), self.mass @ x))

    def pull_back(self, x: Real, y: Real) -> Real:
        """``[grad c(x)] y``, (n, 3)."""
        return y[:-3, None] * x + self.mass[:, None] * y[-3:]

    def energy(self, x: Real) -> tuple[float, Real]:
        """Dirichlet energy less area, and its gradient (n, 3)."""
        double_area, normal, ab, ac = triangle_normals(x, self.corners)
        force = laplace(self.laplacian, x)
        value = 0.5 * float(np.vdot(x, force)) - 0.5 * float(double_area.sum())
        return value, force - area_gradient(self.corners, normal, ab, ac, len(x))


    def hessian_product(self, x: Real, direction: Real, y: Real, rho: float) -> Real:
        """Hessian of the augmented Lagrangian times a direction (n, 3)."""
        double_area, normal, ab, ac = triangle_normals(x, self.corners)
        out = laplace(self.laplacian, direction)
        out -= area_hessian_product(self.corners, double_area, normal, ab, ac, direction)
        out += (rho * self.constraints(x) - y)[:-3, None] * direction
        along = np.concatenate((np.einsum("ij,ij->i", x, direction), self.mass @ direction))
        return out + self.pull_back(x, rho * along)


def augmented_lagrangian_sphere(
    problem: SphereConstraints, start: Real, *, max_iterations: int, progress: Progress
) -> tuple[Real, tuple[AugmentedLagrangianStep, ...], bool]:
    """Positions (n, 3), the rows of the table, and whether both norms fell below 1e-8.

    The outer iteration is the report's; the inner minimisation is Newton's in a trust region (scipy).
    """
    x, y = start, np.zeros(len(start) + 3)
    rho, updates = FIRST_PENALTY, 0
    history: list[AugmentedLagrangianStep] = []
    for iteration in range(1, max_iterations + 1):
        before = _kkt(problem, x, y)
        x = _minimised(problem, x, y, rho, max(1e-4 / 10.0**iteration, 1e-10))
        c = problem.constraints(x)
        norm = float(np.linalg.norm(c))
        history.append(AugmentedLagrangianStep(rho, norm, before))
        progress("augmented lagrangian", float(np.clip(np.log(max(norm, STOP)) / np.log(STOP), 0.0, 1.0)))
        if norm < 1e-3 / 2.0**updates:
            y = y - rho * c
            updates += 1
        else:
            rho *= 2.0
        if norm < STOP and _kkt(problem, x, y) < STOP:
            return unit(x), tuple(history), True
    return unit(x), tuple(history), False


def _kkt(problem: SphereConstraints, x: Real, y: Real) -> float:
    return float(np.linalg.norm(problem.energy(x)[1] - problem.pull_back(x, y)))


def _minimised(problem: SphereConstraints, x: Real, y: Real, rho: float, tolerance: float) -> Real:
    def augmented(flat: Real) -> tuple[float, Real]:
        place = flat.reshape(-1, 3)
        value, gradient = problem.energy(place)
        c = problem.constraints(place)
        value += float(0.5 * rho * c @ c - y @ c)
        return value, (gradient + problem.pull_back(place, rho * c - y)).reshape(-1)

    def bent(flat: Real, direction: Real) -> Real:
        return problem.hessian_product(flat.reshape(-1, 3), direction.reshape(-1, 3), y, rho).reshape(-1)

    options = {"maxiter": INNER_STEPS, "gtol": tolerance}
    found = minimize(augmented, x.reshape(-1), jac=True, hessp=bent, method="trust-ncg", options=options)
    return np.asarray(found.x, dtype=np.float64).reshape(-1, 3)
