"""A surface flattened from its boundary: turning angles and lengths first, then the inside.

R. Sawhney, K. Crane, "Boundary first flattening", ACM Transactions on Graphics 37(1), 2017. With scale factors exp(u)
the flat surface has the turning angles k - Lbi Lii^-1 Omega + S u, Omega the angle defects inside, k the turning
angles of the surface, S the Dirichlet-to-Neumann map; so either may be given, and the other follows.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import OptionError, SolverError
from ..mesh.surface import Surface
from ..operators.boundary_operator import BoundaryOperator
from ..operators.curvature import curvatures
from ..operators.dirichlet import DirichletProblem
from ..options import FreeOptions
from ..progress import Progress
from .conjugate import extended_without_mirrored_part
from .polygon import closed_polygon

__all__ = ["solve_free"]

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]

TOLERANCE = 1e-12  # of the scale factors that go with given turning angles
SHORTEST = 1e-15  # edge, of the longest, that keeps two vertices in one point apart
SHARES = (0.0, 0.05, 0.2, 0.5, 1.0)  # of turning by the same angle everywhere, where no polygon turns as it should


def solve_free(surface: Surface, problem: DirichletProblem, options: FreeOptions, progress: Progress) -> Complex:
    """Positions (n,) of all vertices in the plane, the first boundary vertex at 0, in the scaled units.

    Raises
    ------
    OptionError
        No polygon has the turning angles asked for, or those that the scale factors lead to.
    SolverError
        No polygon comes near those of the surface.
    """
    loop = problem.boundary
    progress("boundary", 0.0)
    curvature = curvatures(surface, loop)
    flat = curvature[loop] - problem.Lbi @ problem.solve(curvature[problem.interior])  # turning angles where u = 0
    lengths = np.linalg.norm(surface.V[np.roll(loop, -1)] - surface.V[loop], axis=1)
    lengths = np.maximum(lengths, SHORTEST * lengths.max())
    if options.boundary_angles is not None:
        zb = _by_angles(problem, flat, lengths, options.boundary_angles, progress)
        progress("extension", 0.0)
        return problem.extend(zb)
    zb = _by_scale(problem, flat, lengths, options.boundary_scale)
    progress("extension", 0.0)
    return _at_origin(extended_without_mirrored_part(problem, zb), loop)


def _by_angles(problem: DirichletProblem, flat: Real, lengths: Real, angles: Real, progress: Progress) -> Complex:
    flux = (angles - flat).astype(np.complex128)
    u = BoundaryOperator(problem).solved(flux, TOLERANCE, progress, "boundary").real
    u -= (u * lengths).sum() / lengths.sum()
    zb = closed_polygon(angles, _scaled(lengths, u))
    if zb is None:
        raise OptionError(
            "No closed polygon turns by these boundary_angles: its edges would all head one way; "
            "spread the turning over more of the boundary."
        )
    return zb


def _by_scale(problem: DirichletProblem, flat: Real, lengths: Real, scale: Real | None) -> Complex:
    turning = flat
    if scale is not None:
        turning = flat + BoundaryOperator(problem).applied(scale.astype(np.complex128))[0].real
        lengths = _scaled(lengths, scale)
    for share in SHARES:
        zb = closed_polygon((1.0 - share) * turning + share * 2.0 * np.pi / len(turning), lengths)
        if zb is not None:
            return zb
        if scale is not None:
            raise OptionError(
                "No closed polygon has these boundary_scale factors: they would turn all edges one way; "
                "make them smaller, or smoother along the boundary."
            )
    raise SolverError("The boundary can not be laid into the plane; the mesh has faces too thin for it.")


def _scaled(lengths: Real, u: Real) -> Real:
    """Lengths of the edges with the scale factors' logarithms u at the vertices."""
    return lengths * np.exp(0.5 * (u + np.roll(u, -1)))


def _at_origin(z: Complex, loop: NDArray[np.int64]) -> Complex:
    """z moved and turned: the first boundary vertex at 0, the first boundary edge along the real axis."""
    z = z - z[loop[0]]
    first = z[loop[1]]
    return z * (np.conj(first) / abs(first)) if first != 0.0 else z
