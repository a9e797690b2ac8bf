"""Moebius maps of the sphere that bring a map into a normal position.

A. Baden, K. Crane, M. Kazhdan, "Moebius registration", SGP 2018: the map is determined up to rotation by the centre of
mass of the surface's area lying in the middle of the ball.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import SolverError
from ..operators.moebius import Moebius
from .stereographic import from_plane, to_plane

__all__ = ["centred", "landmark_aligned", "principal_rotation", "surface_rotation", "turn_to_pole", "unit"]

Real = NDArray[np.float64]

MOST_STEPS = 200
CENTRED = 1e-14  # of the centre of mass, of a sphere of radius 1


def unit(x: Real) -> Real:
    """Rows (n, 3) scaled to length 1."""
    return x / np.linalg.norm(x, axis=1, keepdims=True)


def centred(x: Real, mass: Real) -> Real:
    """Points (n, 3) of the sphere after the Moebius map, without rotation, that brings their centre of mass to 0.

    Newton's method, each step halved until the centre of mass comes nearer to 0, which it always can: the map exists
    and is unique where no point has half of the mass.

    Parameters
    ----------
    mass : (n,) float64
        Not negative, with sum 1.

    Raises
    ------
    SolverError
        A point has half of the mass or more.
    """
    if mass.max() >= 0.5:
        raise SolverError("One vertex has half of the surface's area; no map to the sphere can be balanced.")
    mean = mass @ x
    for _ in range(MOST_STEPS):
        distance = float(np.linalg.norm(mean))
        if distance <= CENTRED:
            break
        slope = 2.0 * (np.eye(3) - x.T @ (mass[:, None] * x))
        step = -np.linalg.solve(slope + 1e-12 * np.eye(3), mean)
        step *= min(1.0, 0.9 / float(np.linalg.norm(step)))
        for _ in range(60):
            moved = _boosted(x, step)
            there = mass @ moved
            if np.linalg.norm(there) < distance:
                break
            step *= 0.5
        else:
            break
        x, mean = moved, there
    return x


def _boosted(x: Real, c: NDArray[np.floating]) -> Real:
    """The conformal map ``(1 - |c|^2) (x + c) / |x + c|^2 + c`` of the ball onto itself (Baden et al., eq. 3)."""
    shifted = x + c
    square = np.einsum("ij,ij->i", shifted, shifted)
    return unit((1.0 - float(c @ c)) * shifted / square[:, None] + c)


def landmark_aligned(x: Real, landmarks: tuple[int, int, int]) -> Real:
    """The map with the three vertices at (0, 0, -1), (1, 0, 0) and (0, 0, 1)."""
    at = list(landmarks)
    # Turn the third to the pole exactly, then fix the plane by a similarity: infinity stays where it is.
    x = x @ turn_to_pole(x[at[2]]).T
    others = np.delete(np.arange(len(x)), at[2])
    z = np.zeros(len(x), dtype=np.complex128)
    z[others] = to_plane(x[others])
    fitted = Moebius(1.0, -z[at[0]], 0.0, z[at[1]] - z[at[0]])(z)
    out = from_plane(fitted)
    out[at] = [[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    return out


def turn_to_pole(p: Real) -> Real:
    """A rotation (3, 3) that takes the unit vector p to (0, 0, 1)."""
    other = np.eye(3)[np.argmin(np.abs(p))]
    first = np.cross(other, p)
    first /= np.linalg.norm(first)
    return np.stack((first, np.cross(p, first), p))


def principal_rotation(x: Real, mass: Real) -> Real:
    """Rotation (3, 3) to the principal axes of the mass: the widest along x, the least along z.

    The senses of the first two axes are those in which the third moments are positive.
    """
    _, axes = np.linalg.eigh(x.T @ (mass[:, None] * x))
    axes = axes[:, ::-1]
    skew = mass @ (x @ axes) ** 3
    axes = axes * np.where(skew < 0.0, -1.0, 1.0)
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    return axes.T


def surface_rotation(x: Real, V: Real, mass: Real) -> Real:
    """Rotation (3, 3) that brings the map nearest to the surface's own directions (Kabsch 1976)."""
    around = V - mass @ V
    left, _, right = np.linalg.svd(around.T @ (mass[:, None] * x))
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    return left @ flip @ right
