"""Boundaries of few vertices: all boundary angles chosen for the faces' shear, none held by a gauge.

A Moebius map of the disk leaves the energy of a fine boundary alone, but not that of a polygon of few corners inscribed
in the circle: there the three angles that a gauge holds still matter as much as the others. A hole of three vertices
has no others at all, and its triangle's shape decides how the whole surface is sheared. With f_z and f_zbar the
derivatives of a face's map, ``sum w |f_zbar|^2 / sum w |f_z|^2`` can tell, for it does not fall as the image shrinks:
with w the area it is the energy by the area of the image; with w = 1 / |f_z|^2 of the map before, it is the mean
squared shear of all faces, however small their images are. Where the Laplacian is not that of the faces themselves its
own energy by the area is a third measure.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.surface import Surface
from ..operators.dirichlet import DirichletProblem
from ..operators.wirtinger import planar_sides, unfolded_sides, wirtinger
from ..optimize import NewtonStep
from ..optimize.rows import row_history
from .shear_ratio import least_ratios

__all__ = ["area_form", "few_enough", "least_shear"]

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]

FEW = 12  # boundary vertices
ROUNDS = 4  # of weights
SETTLED = 1e-4  # radians, by which the angles change from one round to the next


def few_enough(surface: Surface, problem: DirichletProblem) -> bool:
    """Whether a boundary of few vertices decides on many faces; each vertex costs a back-substitution."""
    count = len(problem.boundary)
    return 3 <= count <= FEW and surface.m >= 2 * count


def least_shear(surface: Surface, problem: DirichletProblem, theta: Real) -> list[tuple[Real, tuple[NewtonStep, ...]]]:
    """Boundary angles (nb,) of the least shear near those given, by the three measures, and the steps to them.

    Faces alike: iteratively reweighted least squares (Lawson 1961).
    """
    slopes, flux, areas = _slopes(surface, problem)
    found, weights = [], areas
    if problem.laplacian.corners is not None:  # not the faces' own energy
        found.append(_least_ratio(flux, area_form(len(theta)), theta))
    for number in range(ROUNDS):
        above, below = (slopes.T * weights) @ slopes.conj(), (slopes.T.conj() * weights) @ slopes
        angles, steps = _least_ratio(above, below, theta)
        if number in (0, ROUNDS - 1):
            found.append((angles, steps))
        if number and np.abs(angles - theta).max() < SETTLED:
            found.append((angles, steps))
            break
        theta = angles
        size = np.abs(slopes @ np.exp(1j * theta)) ** 2
        weights = 1.0 / np.maximum(size, 1e-12 * size.max(initial=0.0) + np.finfo(np.float64).tiny)
    return found


def _slopes(surface: Surface, problem: DirichletProblem) -> tuple[Complex, Real, Real]:
    """f_z (m, nb) of the faces that have area, for each boundary vertex at 1 and all others at 0; the flux (nb, nb) of
    these functions, and the areas (m,).

    The functions are real, so that f_zbar is the conjugate.
    """
    kept = np.setdiff1d(np.arange(surface.m), surface.degenerate)
    corners, geometry = surface.corners[:, kept], surface.geometry
    double_area = geometry.double_area[kept]
    source = tuple(side[kept] for side in unfolded_sides(geometry))
    slopes = np.empty((len(kept), len(problem.boundary)), dtype=np.complex128)
    flux = np.empty((len(problem.boundary), len(problem.boundary)))
    for k, unit in enumerate(np.eye(len(problem.boundary), dtype=np.complex128)):
        z = problem.extend(unit)
        slopes[:, k], _ = wirtinger((source[0], source[1]), planar_sides(z, corners), double_area)
        flux[:, k] = problem.flux(unit, z[problem.interior]).real
    return slopes, 0.5 * (flux + flux.T), 0.5 * double_area


def area_form(count: int) -> Complex:
    """``z* form z`` is the area of the polygon."""
    ahead = np.roll(np.eye(count), 1, axis=1)
    return np.asarray((ahead - ahead.T) / 4j)


def _least_ratio(above: Complex | Real, below: Complex, theta: Real) -> tuple[Real, tuple[NewtonStep, ...]]:
    """Angles of the least ``z* above z / z* below z``, as `least_ratios`; a row for each iterate, the ratio in the
    energy's place."""
    found = least_ratios(above[None].astype(np.complex128), below[None], theta[None])
    if np.isnan(found.value[0]):
        return theta, ()
    return found.theta[0], row_history(found.steps, 0, found.value[0], found.norm[0])
