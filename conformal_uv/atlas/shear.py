"""Boundaries of few vertices: the least shear of all boundary angles, as `disk.relative_energy`, of many disks."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..disk.relative_energy import ROUNDS, SETTLED, area_form
from ..disk.shear_ratio import RatioRows, least_ratios
from ..operators.dirichlet import DirichletProblem
from ..operators.wirtinger import planar_sides, unfolded_sides, wirtinger
from .boundary_rows import FluxMatrices
from .disks import Disks, places
from .loop_rows import LoopRows, loop_rows

__all__ = ["ShearAngles", "least_shears"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]
Bools = NDArray[np.bool_]
Complex = NDArray[np.complex128]


class ShearAngles(NamedTuple):
    """One measure of the shear.

    Attributes
    ----------
    theta : (nb,) float64
        The angles of all boundary vertices; where nothing was found by this measure, those given.
    found : (c,) bool
    rows : list of (disks, RatioRows)
        What the minimisation saw.
    """

    theta: Real
    found: Bools
    rows: list[tuple[Ints, RatioRows]]


def least_shears(
    disks: Disks, problem: DirichletProblem, S: FluxMatrices, intrinsic: Bools, theta: Real, chosen: Ints
) -> list[ShearAngles]:
    """Boundary angles of the least shear near those given, of some disks, by the three measures, in their order.

    Parameters
    ----------
    intrinsic : (c,) bool
        Disks whose Laplacian is not that of their own faces.
    theta : (nb,) float64
    chosen : (k,) int64, ascending
        Disks of few boundary vertices.
    """
    slopes = _slopes(disks, problem, chosen)
    found = [ShearAngles(theta.copy(), np.zeros(len(disks), dtype=bool), []) for _ in range(3)]
    for rows in loop_rows(disks.first_boundary, chosen):
        for part in _alike(disks, rows):
            _minimise(disks, part, slopes, S, intrinsic, theta, found)
    return found
