"""The Moebius map of the disk with the least area distortion.

A map of the disk onto itself that sends a to 0 multiplies areas by ``(1 - |a|^2)^2 / |1 - conj(a) z|^4``, so the
logarithm of a face's area scale changes by 4 Re(conj(a) z) to first order, and the variance of the logarithms over the
surface's area is least by a regression on the faces' places, repeated.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.surface import Surface
from ..operators.moebius import Moebius
from ..operators.wirtinger import planar_sides, signed_double_areas

__all__ = ["balance_point"]

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]

MOST_STEPS = 30
LONGEST_STEP = 0.7
SHORTEST_STEP = 1e-12
NO_FALL = 1e-10  # of the variance, as part of it


def balance_point(surface: Surface, z: Complex) -> complex:
    """The point of the disk that has to go to 0.

    Parameters
    ----------
    z : (n,) complex128
        Positions in the unit disk. Folded faces and those without area do not count.
    """
    image = signed_double_areas(planar_sides(z, surface.corners))
    area = surface.geometry.double_area
    counted = (image > 0.0) & (area > 0.0)
    if not counted.any():
        return 0.0
    a, b, c = (z[corner[counted]] for corner in surface.corners)
    place = (a + b + c) / 3.0
    mass = area[counted] / area[counted].sum()
    log = np.log(image[counted]) - np.log(area[counted])
    moved, variance = Moebius(1.0, 0.0, 0.0, 1.0), _variance(log, mass)
    for _ in range(MOST_STEPS):
        found = _lower(place, log, mass, variance)
        if found is None:
            break
        step, place, log, lower = found
        moved = Moebius.to_zero(step) @ moved
        if variance - lower <= NO_FALL * variance:
            break
        variance = lower
    return complex(moved.disk_centre())


def _lower(place: Complex, log: Real, mass: Real, variance: float) -> tuple[complex, Complex, Real, float] | None:
    """A point sent to 0, and places, logarithms and their variance after that; None where no step lowers it."""
    step = _regression(place, log, mass)
    while abs(step) > SHORTEST_STEP:
        under = 1.0 - np.conj(step) * place
        there = log + 2.0 * np.log1p(-(abs(step) ** 2)) - 2.0 * np.log(under.real**2 + under.imag**2)
        lower = _variance(there, mass)
        if lower < variance:
            return step, (place - step) / under, there, lower
        step *= 0.25
    return None


def _regression(place: Complex, log: Real, mass: Real) -> complex:
    """The step that the first order asks for."""
    x = np.stack((place.real, place.imag))
    x = x - (x @ mass)[:, None]
    weighted = x * mass
    found, *_ = np.linalg.lstsq(4.0 * weighted @ x.T, -(weighted @ log), rcond=None)
    step = complex(found[0], found[1])
    return step / max(1.0, abs(step) / LONGEST_STEP)


def _variance(log: Real, mass: Real) -> float:
    return float(((log - float(log @ mass)) ** 2) @ mass)
