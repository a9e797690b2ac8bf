"""The Dirichlet-to-Neumann map of a factorized surface: boundary values to the flux of their harmonic extension.

It is S = Lbb - Lbi Lii^-1 Lib, applied with the factorization at hand and never formed. Conjugate gradients invert it,
preconditioned by the mesh's own strip along the boundary. On short boundaries a Fourier multiplier does: in any
coordinate that goes once around, the number of a vertex for instance, S is |k| but for what is smooth.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import SolverError
from ..progress import Progress
from .dirichlet import DirichletProblem
from .neumann_strip import SHORT

__all__ = ["BoundaryOperator", "wave_sizes"]

Complex = NDArray[np.complex128]

MOST_STEPS = 500


def wave_sizes(nb: int) -> NDArray[np.float64]:
    """S^+ of the waves along nb boundary vertices, (nb,) in the order of `numpy.fft.fftfreq`; 0 of the constant one."""
    waves = np.maximum(np.abs(np.fft.fftfreq(nb, 1.0 / nb)), 1.0)
    sizes = nb / (2.0 * np.pi * waves)  # a wave's Dirichlet energy in the disk is pi |k|
    sizes[0] = 0.0
    return sizes


class BoundaryOperator:
    """``S x`` and ``S^+ r`` for complex functions on the boundary, (nb,)."""

    def __init__(self, problem: DirichletProblem) -> None:
        self._problem = problem
        self._multiplier = wave_sizes(len(problem.boundary))

    def applied(self, x: Complex) -> tuple[Complex, Complex]:
        """S x, and the interior values of the harmonic extension of x, (ni,)."""
        interior = self._problem.interior_values(x)
        return self._problem.flux(x, interior), interior

    def precondition(self, r: Complex) -> Complex:
        """About ``S^+ r``, with mean 0."""
        if len(r) <= SHORT:
            return np.fft.ifft(np.fft.fft(r) * self._multiplier)
        columns = self._problem.boundary_inverse(r.view(np.float64).reshape(-1, 2))
        smooth: Complex = np.ascontiguousarray(columns).view(np.complex128)[:, 0]
        return smooth - smooth.mean()

    def solved(self, r: Complex, tolerance: float, progress: Progress, stage: str) -> Complex:
        """x with ``S x = r`` and mean 0, to this part of the norm of r; the sum of r is left out.

        Raises
        ------
        SolverError
            The tolerance is not reached.
        """
        rest = r - r.mean()
        goal = tolerance * float(np.linalg.norm(rest))
        x = np.zeros_like(rest)
        smooth = self.precondition(rest)
        search, product = smooth, np.vdot(rest, smooth).real
        for step in range(MOST_STEPS):
            if np.linalg.norm(rest) <= goal:
                return x
            progress(stage, step / (step + 20.0))
            image, _ = self.applied(search)
            length = product / np.vdot(search, image).real
            x = x + length * search
            rest = rest - length * image
            rest -= rest.mean()
            smooth = self.precondition(rest)
            product, previous = np.vdot(rest, smooth).real, product
            search = smooth + (product / previous) * search
        raise SolverError(
            f"The boundary's scale factors are not found in {MOST_STEPS} steps; "
            'faces are too thin, or their number changes too fast: use laplacian="intrinsic-delaunay", or remesh.'
        )
