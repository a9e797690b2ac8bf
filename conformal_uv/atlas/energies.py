"""The energies of the maps of many disks."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..operators.wirtinger import planar_sides, unfolded_sides
from .disks import Disks, neighbours

__all__ = ["energies"]

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]


def energies(disks: Disks, z: Complex) -> tuple[Real, Real]:
    """Conformal and Dirichlet energies (c,), as `operators.wirtinger` has them of one map."""
    p1, p2 = unfolded_sides(disks.geometry)
    q1, q2 = planar_sides(z, disks.corners)
    residual = q2 * p1 - q1 * p2
    lost = (residual.real**2 + residual.imag**2) / (4.0 * disks.geometry.double_area)
    zb = z[disks.loop]
    ahead, _ = neighbours(disks.first_boundary)
    enclosed = np.imag(np.conj(zb) * zb[ahead])
    conformal: Real = np.bincount(disks.of_face, lost, len(disks)).astype(np.float64, copy=False)
    area: Real = 0.5 * np.bincount(disks.of_boundary, enclosed, len(disks))
    return conformal, conformal + area
