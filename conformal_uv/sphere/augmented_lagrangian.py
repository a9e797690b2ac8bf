"""The sphere map in the report's own way: constraints by an augmented Lagrangian, all coordinates free in space.

C. P. Choi's report, section 6, leaves the sphere as further work. Here its method with constraints of the same kind:
``1/2 (|x_i|^2 - 1) = 0`` for every vertex, and the centre of mass at 0, which holds the Moebius freedom that pins held
in the disk. Slower than Newton's method on the sphere, and independent of it: each is the other's oracle.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from ..operators.edge_laplacian import EdgeLaplacian
from .energy import area_gradient, area_hessian_product, laplace, triangle_normals

__all__ = ["SphereProblem"]

Real = NDArray[np.float64]

INNER_STEPS = 200
LEAST_TOLERANCE = 1e-10  # of the inner minimisation


class SphereProblem:
    """The energy of free positions, and the constraints; x (3 n,) are the rows of (n, 3) positions.

    Parameters
    ----------
    laplacian : EdgeLaplacian
    corners : (3, m) int32
    mass : (n,) float64
        Sum 1.
    """

    def __init__(self, laplacian: EdgeLaplacian, corners: NDArray[np.int32], mass: Real) -> None:
        self.laplacian, self.mass = laplacian, mass
        self.corners = corners if laplacian.corners is None else laplacian.corners

    def constraints(self, x: Real) -> Real:
        """c(x): one row for each vertex, three for the centre of mass, (n + 3,)."""
        place = x.reshape(-1, 3)
        return np.concatenate((0.5 * (np.einsum("ij,ij->i", place, place) - 1.0), self.mass @ place))

    def kkt_residual(self, x: Real, y: Real) -> float:
        """Norm of the energy's gradient less the pulled back multipliers."""
        place = x.reshape(-1, 3)
        return float(np.linalg.norm(self.energy(place)[1] - self.pull_back(place, y)))

    def minimised(self, x: Real, y: Real, rho: float, tolerance: float) -> Real:
        """Newton's method in a trust region (scipy)."""

        def augmented(flat: Real) -> tuple[float, Real]:
            place = flat.reshape(-1, 3)
            value, gradient = self.energy(place)
            c = self.constraints(flat)
            value += float(0.5 * rho * c @ c - y @ c)
            return value, (gradient + self.pull_back(place, rho * c - y)).reshape(-1)

        def bent(flat: Real, direction: Real) -> Real:
            return self.hessian_product(flat.reshape(-1, 3), direction.reshape(-1, 3), y, rho).reshape(-1)

        options = {"maxiter": INNER_STEPS, "gtol": max(tolerance, LEAST_TOLERANCE)}
        found = minimize(augmented, x, jac=True, hessp=bent, method="trust-ncg", options=options)
        return np.asarray(found.x, dtype=np.float64)

    def pull_back(self, x: Real, y: Real) -> Real:
        """``[grad c(x)] y`` at positions (n, 3)."""
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
        out += (rho * self.constraints(x.reshape(-1)) - y)[:-3, None] * direction
        along = np.concatenate((np.einsum("ij,ij->i", x, direction), self.mass @ direction))
        return out + self.pull_back(x, rho * along)
