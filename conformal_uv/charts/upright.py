"""Charts turned so that what is up on the surface is up in the texture.

Up is the direction in which the surface rises along an axis, in the mean over the chart. A chart that lies flat rises
nowhere; it is laid as a map is, with the next axis up, and its straight sides along those of the square.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..options import Shape, Upright

__all__ = ["upright_turn"]

Real = NDArray[np.float64]
Ints = NDArray[np.integer]
Complex = NDArray[np.complex128]

AXES = {  # up, and what is up on a map of what lies flat
    Upright.Z: ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
    Upright.Y: ((0.0, 1.0, 0.0), (0.0, 0.0, -1.0)),
}
FLAT = 0.05  # mean sine of the slope
STRAIGHT = 0.3  # part of the boundary's length that runs along two directions more than along others


def upright_turn(V: Real, F: Ints, z: Complex, loop: Ints, shape: Shape, upright: Upright) -> complex:
    """The number of modulus 1 to multiply positions by.

    Parameters
    ----------
    V : (n, 3) float64
        The chart's vertices in space.
    F : (m, 3) integers
    z : (n,) complex128
        Their positions in the plane.
    loop : (nb,) integers
        The boundary; where it names more vertices than there are, those are left out.
    """
    if upright is Upright.NONE:
        return 1.0
    up, beyond = (np.array(axis) for axis in AXES[upright])
    V = V - V[0]
    V = V / (np.abs(V).max() or 1.0)  # squares of what is very large or very small would be lost
    rise = _mean_rise(V, F, z, up)
    flat = abs(rise) < FLAT
    if flat:
        rise = _mean_rise(V, F, z, beyond)
    turn = complex(1j * np.conj(rise) / abs(rise)) if abs(rise) >= FLAT else complex(1.0)
    if shape is Shape.RECTANGLE:
        return _nearest_quarter(turn, 1.0)
    if shape is Shape.FREE and (flat or abs(rise) < FLAT):
        sides = _straight_sides(z[loop[loop < len(z)]])
        return turn if sides is None else _nearest_quarter(turn, sides)
    return turn


def _mean_rise(V: Real, F: Ints, z: Complex, axis: Real) -> complex:
    """Where the surface rises along an axis, as seen in the plane: its slope's sine, the mean over the area.

    The sine is the surface's, only the direction the image's: in a face that the map squeezes to nothing the gradient
    in the plane is as long as one likes.
    """
    a, b, c = (V[corner] for corner in F.T)
    first, second = b - a, c - a
    normal = np.cross(first, second)
    total = float(np.linalg.norm(normal, axis=1).sum())
    if not total > 0.0:
        return 0.0
    q1, q2 = z[F[:, 1]] - z[F[:, 0]], z[F[:, 2]] - z[F[:, 0]]
    upward = -1j * ((first @ axis) * q2 - (second @ axis) * q1)  # the gradient over the image's double area
    counted = (q1.real * q2.imag - q1.imag * q2.real > 0.0) & (np.abs(upward) > 0.0)
    slope = np.linalg.norm(np.cross(normal, axis), axis=1)
    return complex((slope[counted] * upward[counted] / np.abs(upward[counted])).sum() / total)


def _straight_sides(boundary: Complex) -> complex | None:
    """The turn that lays the straight sides of a polygon along the axes; None where there are none."""
    edges = np.roll(boundary, -1) - boundary
    lengths = np.abs(edges)
    along = edges[lengths > 0.0] / lengths[lengths > 0.0]
    moment = complex((lengths[lengths > 0.0] * along**4).sum())
    if abs(moment) < STRAIGHT * float(lengths.sum()):
        return None
    return complex(np.exp(-0.25j * np.angle(moment)))


def _nearest_quarter(turn: complex, sides: complex) -> complex:
    """`sides` and so many quarter turns that it comes nearest to `turn`."""
    quarters = round(float(np.angle(turn / sides)) / (0.5 * np.pi))
    return sides * complex(1j**quarters)
