"""Energy of a disk map as a function of its boundary angles, the interior eliminated.

With z = exp(i theta) and S the boundary flux operator, the Dirichlet energy is ``1/2 z* S z``; the conformal
energy subtracts the area of the image, ``1/2 sum_k sin(theta_(k+1) - theta_k)``. Pinkall and Polthier 1993.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..operators.dirichlet import DirichletProblem

__all__ = ["BoundaryEnergy"]

Real = NDArray[np.float64]


class BoundaryEnergy:
    """The energy, its gradient and products with its Hessian at one vector of angles.

    Parameters
    ----------
    problem : DirichletProblem
    theta : (nb,) float64
        Angles in the order of the boundary.
    minus_area : bool
        True for the conformal energy, False for the Dirichlet energy.

    Attributes
    ----------
    z : (nb,) complex128
    interior : (ni,) complex128
        Harmonic extension of z.
    value : float
    gradient : (nb,) float64
    """

    def __init__(self, problem: DirichletProblem, theta: Real, *, minus_area: bool) -> None:
        self.problem, self.theta, self.minus_area = problem, theta, minus_area
        self.z = np.exp(1j * theta)
        self.interior = problem.interior_values(self.z)
        flux = problem.flux(self.z, self.interior)
        self.value = 0.5 * float(np.real(np.vdot(self.z, flux)))
        self._radial = np.real(np.conj(self.z) * flux)
        self.gradient: Real = np.imag(np.conj(self.z) * flux)
        if minus_area:
            gap = np.roll(theta, -1) - theta
            self._sine, cosine = np.sin(gap), np.cos(gap)
            self.value -= 0.5 * float(self._sine.sum())
            self.gradient -= 0.5 * (np.roll(cosine, 1) - cosine)

    def positions(self) -> NDArray[np.complex128]:
        """Boundary and extension together, (n,)."""
        out: NDArray[np.complex128] = np.empty(self.problem.n, dtype=np.complex128)
        out[self.problem.boundary], out[self.problem.interior] = self.z, self.interior
        return out

    def hessian_product(self, direction: Real) -> Real:
        """Hessian times a direction (nb,), by one harmonic extension."""
        change = 1j * self.z * direction
        return self._product(direction, self.problem.flux(change, self.problem.interior_values(change)))

    @property
    def moebius_moves(self) -> Real:
        """The directions (nb, 2) in which maps of the disk that move 0 turn the angles.

        One that moves 0 to a turns them by ``2 Im(a exp(-i theta))`` to first order.
        """
        return np.column_stack((-2.0 * np.sin(self.theta), 2.0 * np.cos(self.theta)))

    def moebius_products(self) -> Real:
        """Hessian times `moebius_moves`, (nb, 2).

        They move z by ``1 - z^2`` and ``i (1 + z^2)``. Constants have no flux, so the extension of z^2 serves both.
        """
        square = self.z * self.z
        flux = self.problem.flux(square, self.problem.interior_values(square))
        one, other = self.moebius_moves.T
        return np.column_stack((self._product(one, -flux), self._product(other, 1j * flux)))

    def _product(self, direction: Real, flux: NDArray[np.complex128]) -> Real:
        """Hessian times a direction whose change of z has this flux."""
        product = np.imag(np.conj(self.z) * flux)
        product -= self._radial * direction
        if self.minus_area:
            before = np.roll(self._sine, 1)
            product += 0.5 * (self._sine + before) * direction
            product -= 0.5 * (self._sine * np.roll(direction, -1) + before * np.roll(direction, 1))
        return product
