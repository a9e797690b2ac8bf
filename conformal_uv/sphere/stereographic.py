"""Stereographic projection between the plane and the unit sphere, seen from outside the sphere."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["from_plane", "to_plane"]

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]


def from_plane(z: Complex) -> Real:
    """Points (n, 3) of the sphere for complex numbers z (n,): 0 goes to (0, 0, -1), infinity to (0, 0, 1).

    The plane is conjugated, so that what is anticlockwise in it is anticlockwise from outside the sphere.
    """
    square = z.real**2 + z.imag**2
    return np.column_stack((2.0 * z.real, -2.0 * z.imag, square - 1.0)) / (1.0 + square)[:, None]


def to_plane(xyz: Real) -> Complex:
    """Complex numbers (n,) for points (n, 3) of the sphere; the north pole itself has none."""
    x, y, z = xyz.T
    above = 1.0 - z
    small = above < 0.5  # near the pole 1 - z is better had from x^2 + y^2
    above[small] = (x[small] ** 2 + y[small] ** 2) / (1.0 + z[small])
    return (x - 1j * y) / above
