"""What a map spread over ranks is like: each rank measures the faces that it counts, a block at a time."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..mesh.geometry import TriangleGeometry
from ..operators.distortion import distortion_of
from ..operators.plane_map import unresolved_faces
from ..operators.wirtinger import conformal_energy, enclosed_area
from .part import Part

__all__ = ["MapNumbers", "map_numbers"]

Complex = NDArray[np.complex128]

FACES = 1 << 18  # measured at a time


class MapNumbers(NamedTuple):
    """Distortion over all triangles, in the units of `DistortionNumbers`.

    Attributes
    ----------
    dirichlet_energy, conformal_energy : float
    angle_mean, angle_rms, angle_sd, angle_max : float
        Degrees.
    quasi_conformal_max : float
    area_ratio : float or None
        Largest over smallest change of area, of triangles that have one.
    lost_to_double : int
        Folded faces whose height is within rounding.
    """

    dirichlet_energy: float
    conformal_energy: float
    angle_mean: float
    angle_rms: float
    angle_sd: float
    angle_max: float
    quasi_conformal_max: float
    area_ratio: float | None
    lost_to_double: int


def map_numbers(part: Part, z: Complex, zb: Complex) -> MapNumbers:
    """Of positions at the local vertices, zb (nb,) those of the boundary."""
    ranks = part.ranks
    uv = np.ascontiguousarray(z).view(np.float64).reshape(-1, 2)
    sums, most = np.zeros(4), np.array([0.0, 0.0, -np.inf, -np.inf])  # error, ratio, log of area scale and minus it
    with ranks.agreed():
        faces = np.flatnonzero(part.counted)
        for start in range(0, len(faces), FACES):
            here = faces[start : start + FACES]
            corners = part.corners.take(here, axis=1)
            geometry = TriangleGeometry(part.geometry.dot.take(here, axis=1), part.geometry.double_area.take(here))
            found = distortion_of(geometry, corners, uv, part.unit)
            error, area = found.angle_error, found.area_scale
            lost = len(unresolved_faces(z, corners, found.flipped))
            sums += error.sum(), (error * error).sum(), conformal_energy(geometry, z, corners), lost
            usable = area[np.isfinite(area) & (area > 0.0)]
            logs = np.log([usable.max(), usable.min()]) if len(usable) else np.array([-np.inf, np.inf])
            most = np.maximum(most, [error.max(), found.quasi_conformal.max(), logs[0], -logs[1]])
    error, square, conformal, lost = ranks.total(sums)
    largest, ratio, high, low = (ranks.most(float(value)) for value in most)
    count = 3.0 * part.faces.count
    mean = float(error / count)
    return MapNumbers(
        dirichlet_energy=float(conformal) + enclosed_area(zb),
        conformal_energy=float(conformal),
        angle_mean=mean,
        angle_rms=float(np.sqrt(square / count)),
        angle_sd=float(np.sqrt(max(square / count - mean * mean, 0.0))),
        angle_max=largest,
        quasi_conformal_max=ratio,
        area_ratio=float(np.exp(high + low)) if np.isfinite(high + low) else None,
        lost_to_double=int(lost),
    )
