"""The part of a boundary curve that keeps angles, told from the part that mirrors them.

The extension of a curve z is conformal where its flux is the curve's derivative turned by a right angle: S z = -i D z
with (D z)_k = (z_k+1 - z_k-1) / 2. Curves with S z = i D z are those of mirrored maps. So z - S^+ (S + i D) z / 2 is
what is left of z without its mirrored part, in whatever way z is turned. A curve made from lengths and turning angles
has such a part where the surface has ears or bends sharply at its boundary, and a harmonic extension of both
coordinates shows it as angle error. One step of conjugate gradients is enough of S^+.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..operators.boundary_operator import BoundaryOperator
from ..operators.dirichlet import DirichletProblem

__all__ = ["extended", "extended_without_mirrored_part"]

Complex = NDArray[np.complex128]

WORTH = 0.01  # part of the conformal energy by which it has to fall
ROUNDING = 1e-13  # of the energy, as part of the area


def extended(problem: DirichletProblem, zb: Complex, interior: Complex) -> Complex:
    """Boundary and interior values (n,) in one."""
    z = np.empty(problem.n, dtype=np.complex128)
    z[problem.boundary], z[problem.interior] = zb, interior
    return z


def extended_without_mirrored_part(problem: DirichletProblem, zb: Complex) -> Complex:
    """Harmonic extension (n,) of the boundary curve zb (nb,), less its mirrored part if that is worth the step.

    The conformal energy is 1/2 z* (S + i D) z; half of ``S^+ residual`` lowers it by 3/8 residual* S^+ residual.
    """
    operator = BoundaryOperator(problem)
    flux, interior = operator.applied(zb)
    residual = flux + 0.5j * (np.roll(zb, -1) - np.roll(zb, 1))
    energy, dirichlet = 0.5 * np.vdot(zb, residual).real, 0.5 * np.vdot(zb, flux).real
    search = operator.precondition(residual)
    fall = 0.375 * np.vdot(residual, search).real
    if fall <= WORTH * max(energy, ROUNDING * dirichlet):
        return extended(problem, zb, interior)
    image, inside = operator.applied(search)
    curvature = np.vdot(search, image).real
    if not curvature > 0.0:
        return extended(problem, zb, interior)
    length = -0.5 * np.vdot(search, residual).real / curvature
    return extended(problem, zb + length * search, interior + length * inside)
