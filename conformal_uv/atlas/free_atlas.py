"""Many small disks factorized together, flattened with free boundaries.

As `free.solution` flattens one: turning angles and lengths of all boundaries, the polygons closed a row for each, one
harmonic extension, and the mirrored parts taken out of those for which it is worth the step.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..free.conjugate import ROUNDING, WORTH
from ..operators.boundary_operator import wave_sizes
from ..operators.orientation_sign import collapsed_faces
from ..options import FreeOptions
from ..progress import Progress
from .disks import Disks, neighbours
from .factorized_disks import FactorizedDisks
from .free_maps import FreeMaps
from .loop_rows import loop_rows
from .polygon_rows import closed_rows, crossing_rows

__all__ = ["FreeAtlas", "Frames", "takes_free"]

Real = NDArray[np.float64]
Bools = NDArray[np.bool_]
Complex = NDArray[np.complex128]
Frames = Callable[[Complex], Complex]


def takes_free(options: FreeOptions) -> bool:
    """Whether disks are flattened together with these options."""
    return not options.refine and options.boundary_scale is None and options.boundary_angles is None


class FreeAtlas:
    """Maps of many disks with free boundaries.

    Results are those of `free_map`, disk by disk, to rounding. Disks with folded faces, with boundaries that cross
    themselves or can not be closed as they should are left out of the results.
    """

    def __init__(self, factorized: FactorizedDisks) -> None:
        self._factorized = factorized
        self._flat: tuple[Complex, Bools] | None = None

    def maps(self, frames: Frames, progress: Progress) -> FreeMaps:
        """The maps, and where `frames` puts their positions (n,)."""
        if self._flat is None:
            progress("boundary", 0.0)
            self._flat = self._solved()
        z, good = self._flat
        return FreeMaps(self._factorized, z, frames(z), good)

    def _solved(self) -> tuple[Complex, Bools]:
        """Positions (n,) of all vertices, each disk's first boundary vertex at 0, and which disks (c,) are good."""
        disks, problem = self._factorized.disks, self._factorized.problem
        zb, good = self._polygons()
        ahead, behind = neighbours(disks.first_boundary)
        interior = problem.interior_values(zb)
        flux = problem.flux(zb, interior)
        residual = flux + 0.5j * (zb[ahead] - zb[behind])
        energy, dirichlet = 0.5 * self._product(zb, residual), 0.5 * self._product(zb, flux)
        search = _preconditioned(disks, residual)
        fall = 0.375 * self._product(residual, search)
        worth = fall > WORTH * np.maximum(energy, ROUNDING * dirichlet)
        search[~worth[disks.of_boundary]] = 0.0
        if worth.any():
            inside = problem.interior_values(search)
            curvature = self._product(search, problem.flux(search, inside))
            worth &= curvature > 0.0
            length = np.where(worth, -0.5 * self._product(search, residual) / np.where(worth, curvature, 1.0), 0.0)
            zb = zb + length[disks.of_boundary] * search
            interior = interior + length[disks.of_vertex[problem.interior]] * inside
        z = np.empty(disks.n, dtype=np.complex128)
        z[disks.loop], z[problem.interior] = zb, interior
        z = _at_origin(disks, z)
        good &= ~np.isin(np.arange(len(disks)), disks.of_face[collapsed_faces(z, disks.corners)])
        for rows in loop_rows(disks.first_boundary):
            good[rows.disk] &= ~crossing_rows(z[disks.loop[rows.at]])
        with np.errstate(over="ignore"):
            good[disks.of_vertex[~np.isfinite(np.abs(z) * disks.unit[disks.of_vertex])]] = False
        return z, good

    def _polygons(self) -> tuple[Complex, Bools]:
        """The closed boundaries (nb,), and which of them (c,) turn as the surfaces ask for."""
        disks, problem = self._factorized.disks, self._factorized.problem
        angles = np.arctan2(disks.geometry.double_area, disks.geometry.dot)
        total = np.bincount(disks.corners.reshape(-1), angles.reshape(-1), disks.n)
        inside = 2.0 * np.pi - total[problem.interior]
        turning = np.pi - total[disks.loop] - problem.Lbi @ problem.solve(inside)
        ahead, _ = neighbours(disks.first_boundary)
        lengths = np.linalg.norm(disks.V[disks.loop[ahead]] - disks.V[disks.loop], axis=1)
        zb, good = np.empty(len(disks.loop), dtype=np.complex128), np.zeros(len(disks), dtype=bool)
        for rows in loop_rows(disks.first_boundary):
            zb[rows.at], good[rows.disk] = closed_rows(turning[rows.at], lengths[rows.at])
        return zb, good

    def _product(self, one: Complex, other: Complex) -> Real:
        """Real parts of the products of functions on the boundaries, (c,)."""
        disks = self._factorized.disks
        return np.bincount(disks.of_boundary, np.real(np.conj(one) * other), len(disks)).astype(np.float64, copy=False)


def _preconditioned(disks: Disks, residual: Complex) -> Complex:
    """As `BoundaryOperator.precondition`, disk by disk."""
    out = np.empty_like(residual)
    for rows in loop_rows(disks.first_boundary):
        out[rows.at] = np.fft.ifft(np.fft.fft(residual[rows.at], axis=1) * wave_sizes(rows.at.shape[1]), axis=1)
    return out


def _at_origin(disks: Disks, z: Complex) -> Complex:
    """The first boundary vertex of every disk at 0, its first boundary edge along the real axis."""
    begin = disks.first_boundary[:-1]
    z = z - z[disks.loop[begin]][disks.of_vertex]
    first = z[disks.loop[begin + 1]]
    size = np.abs(first)
    return z * np.where(size > 0.0, np.conj(first) / np.where(size > 0.0, size, 1.0), 1.0)[disks.of_vertex]
