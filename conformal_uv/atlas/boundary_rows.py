"""The conformal energies of many disks as functions of their boundary angles, a row of angles for each.

As `disk.boundary_energy.BoundaryEnergy`, for boundaries so short that their flux operators are at hand as matrices.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..operators.dirichlet import DirichletProblem
from .loop_rows import LoopRows

__all__ = ["EnergyRows", "FluxMatrices", "centred_rows"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]
Complex = NDArray[np.complex128]

RESTORED = 1e-15  # the last step of centring
MOST_ROUNDS = 50


class FluxMatrices:
    """``S = Lbb - Lbi Lii^-1 Lib`` of every disk, of two columns of all disks at a time the flux of one function.

    Parameters
    ----------
    problem : DirichletProblem
    first_boundary : (c + 1,) int64
        Where the boundary of each disk begins.
    """

    def __init__(self, problem: DirichletProblem, first_boundary: Ints) -> None:
        count = np.diff(first_boundary)
        self._begin = np.concatenate((np.zeros(1, dtype=np.int64), np.cumsum(count**2)))
        place = np.arange(first_boundary[-1]) - np.repeat(first_boundary[:-1], count)
        length = np.repeat(count, count)
        row = np.repeat(self._begin[:-1], count) + place * length
        self._entries = np.empty(self._begin[-1])
        for column in range(0, int(count.max()), 2):
            z = (place == column) + 1j * (place == column + 1)
            flux = problem.flux(z, problem.interior_values(z))
            for part, k in ((flux.real, column), (flux.imag, column + 1)):
                self._entries[row[length > k] + k] = part[length > k]

    def of(self, rows: LoopRows) -> Real:
        """Those of some disks, (r, nb, nb)."""
        nb = rows.at.shape[1]
        return self._entries[self._begin[rows.disk][:, None] + np.arange(nb * nb)].reshape(-1, nb, nb)


def centred_rows(theta: Real, measure: Real) -> Real:
    """Angles after maps of the disk that bring the mean of the points by the measure to 0, the mean angle kept.

    As `disk.gauge.CentreGauge.restore`, row by row.
    """
    mean = np.einsum("rk,rk->r", measure, theta)
    theta, moving = theta.copy(), np.arange(len(theta))
    for _ in range(MOST_ROUNDS):
        z = np.exp(1j * theta[moving])
        step = _centring_steps(z, measure[moving])
        theta[moving] += 2.0 * np.angle(1.0 - step[:, None] * np.conj(z))
        moving = moving[np.abs(step) >= RESTORED]
        if not len(moving):
            break
    return theta + (mean - np.einsum("rk,rk->r", measure, theta))[:, None]


def _centring_steps(z: Complex, weights: Real) -> Complex:
    """As `operators.moebius.centring_step`, row by row."""
    s, q = np.einsum("rk,rk->r", weights, z), np.einsum("rk,rk->r", weights, z * z)
    step = (s + q * np.conj(s)) / np.maximum(1.0 - np.abs(q) ** 2, 1e-3)
    return np.asarray(step / np.maximum(1.0, 2.0 * np.abs(step)))


class EnergyRows:
    """The energies, gradients and Hessians of r disks at angles theta (r, nb).

    Parameters
    ----------
    S : (r, nb, nb) float64
        Flux operators.
    theta : (r, nb) float64

    Attributes
    ----------
    z : (r, nb) complex128
    value : (r,) float64
    gradient : (r, nb) float64
    """

    def __init__(self, S: Real, theta: Real) -> None:
        self.S, self.theta = S, theta
        self.z = np.exp(1j * theta)
        flux = np.einsum("rkl,rl->rk", S, self.z)
        turned = np.conj(self.z) * flux
        self._radial = turned.real
        gap = np.roll(theta, -1, axis=1) - theta
        self._sine, cosine = np.sin(gap), np.cos(gap)
        self.value = 0.5 * self._radial.sum(axis=1) - 0.5 * self._sine.sum(axis=1)
        self.gradient: Real = turned.imag - 0.5 * (np.roll(cosine, 1, axis=1) - cosine)

    def some(self, kept: NDArray[np.bool_]) -> EnergyRows:
        """Some of the disks."""
        part = EnergyRows.__new__(EnergyRows)
        for name, values in vars(self).items():
            setattr(part, name, values[kept])
        return part

    def hessian(self) -> Real:
        """(r, nb, nb)."""
        _, nb = self.theta.shape
        H = self.S * np.real(np.conj(self.z)[:, :, None] * self.z[:, None, :])
        k, after = np.arange(nb), np.roll(np.arange(nb), -1)
        before = np.roll(self._sine, 1, axis=1)
        H[:, k, k] += 0.5 * (self._sine + before) - self._radial
        H[:, k, after] -= 0.5 * self._sine
        H[:, after, k] -= 0.5 * self._sine
        return H

    def moebius_moves(self) -> Real:
        """The two directions (r, nb, 2) in which maps of the disk that move 0 turn the angles."""
        return np.stack((-2.0 * np.sin(self.theta), 2.0 * np.cos(self.theta)), axis=2)
