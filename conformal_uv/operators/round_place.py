"""The circle or axis-parallel ellipse on which points of the plane lie, and the unit disk it stands for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["RoundPlace", "fitted_place"]

Points = NDArray[np.float64]

FEWEST = 5  # points: every triangle and every rectangle has its corners on a circle
FEWEST_ON_ELLIPSE = 7  # four fix an axis-parallel one


@dataclass(frozen=True)
class RoundPlace:
    """The image of the unit disk under ``w -> center + (w_x radii_x, w_y radii_y)``.

    Attributes
    ----------
    center : (2,) floats
    radii : (2,) floats
        Different on an image that is not square.
    """

    center: tuple[float, float]
    radii: tuple[float, float]

    def to_disk(self, points: Points) -> NDArray[np.complex128]:
        """Points (k, 2) as complex numbers (k,) of the unit disk."""
        return np.ascontiguousarray((np.asarray(points, dtype=np.float64) - self.center) / self.radii).view(
            np.complex128
        )[..., 0]

    def from_disk(self, z: NDArray[np.complex128]) -> Points:
        """Complex numbers (k,) of the unit disk as points (k, 2)."""
        return np.ascontiguousarray(z)[..., None].view(np.float64) * self.radii + self.center

    def deviation(self, points: Points) -> float:
        """How far points (k, 2) lie from the curve, at most, in radii."""
        return float(np.abs(np.abs(self.to_disk(points)) - 1.0).max(initial=0.0))


def fitted_place(points: Points, tolerance: float) -> RoundPlace | None:
    """The circle, or else the axis-parallel ellipse, that points (k, 2) lie on to so many radii; None where there is
    none, or the points are too few to tell.

    Least squares of the algebraic equation (I. Kasa, 1976), exact where the points lie on the curve.
    """
    if len(points) < FEWEST or not np.isfinite(points).all():
        return None
    middle = points.mean(axis=0)
    unit = float(np.abs(points - middle).max())
    if not unit > 0.0:
        return None
    for fit, fewest in ((_circle, FEWEST), (_ellipse, FEWEST_ON_ELLIPSE)):
        if len(points) < fewest:
            continue
        center, squares = fit((points - middle) / unit)
        if not (np.isfinite(squares).all() and (squares > 0.0).all()):
            continue
        u, v = (middle + unit * center).tolist()
        place = RoundPlace((u, v), tuple((unit * np.sqrt(squares)).tolist()))
        if place.deviation(points) <= tolerance:
            return place
    return None


def _circle(x: Points) -> tuple[Points, Points]:
    """Center and squared radii of ``|x|^2 = 2 c.x + s``."""
    columns = np.column_stack((2.0 * x, np.ones(len(x))))
    *center, s = np.linalg.lstsq(columns, (x * x).sum(axis=1), rcond=None)[0]
    middle = np.array(center)
    return middle, np.full(2, s + middle @ middle)


def _ellipse(x: Points) -> tuple[Points, Points]:
    """Center and squared radii of ``A x^2 + B y^2 + C x + D y = 1``; the mean of the points lies inside."""
    a, b, c, d = np.linalg.lstsq(np.column_stack((x * x, x)), np.ones(len(x)), rcond=None)[0]
    with np.errstate(divide="ignore", invalid="ignore"):
        center = np.array([-c / (2.0 * a), -d / (2.0 * b)])
        level = 1.0 + a * center[0] ** 2 + b * center[1] ** 2
        return center, np.array([level / a, level / b])
