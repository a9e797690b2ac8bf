"""All vertices moved until the faces' angles are best, without a fold on the way.

The energy is that of `BarrierPlace`. Its minimum has the least squared distortion, and mostly, not always, the least
mean angle error. So the best map of all that come by is kept, the first one included.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import SolverError
from ..mesh.surface import Surface
from ..operators.conformal_barrier import BarrierPlace, FaceDerivatives
from ..operators.distortion import distortion_of
from ..operators.orientation_sign import orientation_signs
from ..optimize import Status, lbfgs
from ..progress import Progress

__all__ = ["angle_mean", "refined"]

Complex = NDArray[np.complex128]

TOLERANCE = 1e-4  # part of the energy, and some hundredths of a percent of the angles
MOST_STEPS = 200


def angle_mean(surface: Surface, z: Complex) -> float:
    """Mean angle error of positions z (n,) over all corners, degrees."""
    points = np.ascontiguousarray(z).view(np.float64).reshape(-1, 2)
    return distortion_of(surface.geometry, surface.corners, points).angle_mean


def refined(
    surface: Surface, loop: NDArray[np.int64], z: Complex, backend: str, progress: Progress
) -> tuple[Complex, Status]:
    """Positions with less mean angle error and no face folded that was not; z itself where none are found.

    The first vertex of the loop and the one farthest from it stay, so that the map keeps its place and its size.
    Faces without area, and those folded in z, do not count.
    """
    signs = orientation_signs(z.view(np.float64).reshape(-1, 2), surface.corners)
    counted = signs > 0
    counted[surface.degenerate] = False
    free = np.ones(surface.n, dtype=bool)
    free[[loop[0], loop[np.argmax(np.abs(z[loop] - z[loop[0]]))]]] = False
    faces = np.flatnonzero(counted)
    vertices = np.intersect1d(np.flatnonzero(free), surface.corners[:, faces])  # nothing holds the others
    start = BarrierPlace(FaceDerivatives(surface, faces), vertices, z)
    if not start.finite or not len(vertices):
        return z, Status.STALLED
    progress("refinement", 0.0)
    best = _Best(surface, z, signs > 0)
    try:
        inverse = start.held_hessian(surface.V[vertices], backend).solve
    except SolverError:  # slivers
        return z, Status.STALLED
    _, status = lbfgs(
        start,
        inverse,
        tolerance=TOLERANCE,
        max_iterations=MOST_STEPS,
        progress=progress,
        stage="refinement",
        watch=best.see,
    )
    return (z, Status.ANGLES) if best.z is z else (best.z, status)


class _Best:
    """The positions of least mean angle error that have come by."""

    def __init__(self, surface: Surface, z: Complex, upright: NDArray[np.bool_]) -> None:
        self.z = z
        self._surface, self._upright = surface, upright
        self._least = angle_mean(surface, z)

    def see(self, place: BarrierPlace) -> None:
        """Take the place if it is better, and folds nothing that was not folded."""
        mean = angle_mean(self._surface, place.z)
        if mean < self._least:
            signs = orientation_signs(place.z.view(np.float64).reshape(-1, 2), self._surface.corners)
            if (signs[self._upright] > 0).all():
                self.z, self._least = place.z, mean
