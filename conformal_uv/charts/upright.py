"""Charts turned so that what is up on the surface is up in the texture.

Up is the direction in which the surface rises along an axis, in the mean over the chart. A chart that lies flat rises
nowhere; it is laid as a map is, with the next axis up, and its straight sides along those of the square.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.blocks import by_blocks
from ..options import Shape, Upright

__all__ = ["straight_sides", "summed_rises", "turns_and_flats", "upright_turn", "upright_turns"]

Real = NDArray[np.float64]
Ints = NDArray[np.integer]
Complex = NDArray[np.complex128]

AXES = {  # which is up, and which way; and what is up on a map of what lies flat
    Upright.Z: ((2, 1.0), (1, 1.0)),
    Upright.Y: ((1, 1.0), (2, -1.0)),
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
    whole = np.zeros(len(F), dtype=np.int64)
    (turn,), (flat,) = _turns_and_flats(V - V[0], F, z, whole, np.ones(1) * np.abs(V - V[0]).max(), upright)
    if shape is Shape.RECTANGLE:
        return _nearest_quarter(turn, 1.0)
    if shape is Shape.FREE and flat:
        sides = _straight_sides(z[loop[loop < len(z)]])
        return turn if sides is None else _nearest_quarter(turn, sides)
    return turn


def upright_turns(
    V: Real, F: Ints, z: Complex, first_vertex: Ints, chart: Ints, upright: Upright, sides: Complex | None = None
) -> Complex:
    """The same for c disks, or charts with free boundaries, one after another, (c,).

    Parameters
    ----------
    V, F, z
        Of all of them; F numbers all vertices.
    first_vertex : (c,) integers
        The first vertex of each disk.
    chart : (m,) integers
        The disk of each face.
    sides : (c,) complex, optional
        Where boundaries are free: the turn that lays the straight sides of each along the axes, 0 where it has none.
    """
    if upright is Upright.NONE:
        return np.ones(len(first_vertex), dtype=np.complex128)
    count = np.diff(np.append(first_vertex, len(V)))
    V = V - np.repeat(V[first_vertex], count, axis=0)
    turn, flat = _turns_and_flats(V, F, z, chart, np.maximum.reduceat(np.abs(V).max(axis=1), first_vertex), upright)
    if sides is None:
        return turn
    straight = flat & (sides != 0.0)
    quarters = np.round(np.angle(turn * np.conj(sides)) / (0.5 * np.pi)).astype(np.int64)
    return np.where(straight, sides * np.array([1.0, 1j, -1.0, -1j])[quarters % 4], turn)


def _turns_and_flats(
    V: Real, F: Ints, z: Complex, chart: Ints, size: Real, upright: Upright
) -> tuple[Complex, NDArray[np.bool_]]:
    """What to multiply the charts' positions by, (c,), and which of them lie flat along an axis.

    `chart` (m,), ascending, is that of each face, `size` (c,) its largest coordinate.
    """
    return turns_and_flats(*summed_rises(V, F, z, chart, size, upright))


def turns_and_flats(total: Real, rises: list[Complex]) -> tuple[Complex, NDArray[np.bool_]]:
    """The same from what `summed_rises` gives."""
    up, beyond = (np.divide(rise, total, out=np.zeros_like(rise), where=total > 0.0) for rise in rises)
    flat = np.abs(up) < FLAT
    rise = np.where(flat, beyond, up)
    length = np.abs(rise)
    steep = length >= FLAT
    turn = np.where(steep, 1j * np.conj(rise) / np.where(steep, length, 1.0), 1.0)
    return turn, flat | ~steep


def summed_rises(V: Real, F: Ints, z: Complex, chart: Ints, size: Real, upright: Upright) -> tuple[Real, list[Complex]]:
    """Areas of charts (c,), up to a factor, and how they rise along axes, as seen in the plane, (c,) each: the slope's
    sine over the area.

    The sine is the surface's, only the direction the image's: in a face that the map squeezes to nothing the gradient
    in the plane is as long as one likes.
    """
    axes = AXES[upright]
    columns = np.ascontiguousarray(V.T)
    unit = np.where(size > 0.0, size, 1.0)  # squares of what is very large or very small would be lost

    def summed(part: slice) -> tuple[int, Real, list[Complex]]:
        a, b, c = F[part].T.astype(np.intp)
        own, scale = chart[part], 1.0 / unit[chart[part]]
        origin = [column.take(a) for column in columns]
        first = [(column.take(b) - x) * scale for column, x in zip(columns, origin, strict=True)]
        second = [(column.take(c) - x) * scale for column, x in zip(columns, origin, strict=True)]
        normal = [first[i - 2] * second[i - 1] - first[i - 1] * second[i - 2] for i in range(3)]
        at = z.take(a)
        q1, q2 = z.take(b) - at, z.take(c) - at
        upside = q1.real * q2.imag - q1.imag * q2.real > 0.0
        own = own - (lowest := int(own[0]))
        rises = []
        for axis, sign in axes:
            upward = -1j * sign * (first[axis] * q2 - second[axis] * q1)  # the gradient over the image's double area
            length = np.abs(upward)
            slope = np.hypot(normal[axis - 2], normal[axis - 1])
            counted = upside & (length > 0.0)
            rise = np.divide(slope * upward, length, out=np.zeros(len(own), dtype=np.complex128), where=counted)
            rises.append(np.bincount(own, rise.real) + 1j * np.bincount(own, rise.imag))
        area: Real = np.bincount(own, np.sqrt(sum(x * x for x in normal))).astype(np.float64, copy=False)
        return lowest, area, rises

    total, rises = np.zeros(len(size)), [np.zeros(len(size), dtype=np.complex128) for _ in axes]
    for lowest, area, found in by_blocks(summed, len(F)):
        here = slice(lowest, lowest + len(area))
        total[here] += area
        for rise, more in zip(rises, found, strict=True):
            rise[here] += more
    return total, rises


def _straight_sides(boundary: Complex) -> complex | None:
    """The turn that lays the straight sides of a polygon along the axes; None where there are none."""
    (turn,) = straight_sides(np.roll(boundary, -1) - boundary, np.zeros(len(boundary), dtype=np.int64), 1)
    return None if turn == 0.0 else complex(turn)


def straight_sides(edges: Complex, polygon: Ints, count: int) -> Complex:
    """The same for `count` polygons by their edges and whose those are; 0 where there are none."""
    lengths = np.abs(edges)
    along = np.divide(edges, lengths, out=np.zeros_like(edges), where=lengths > 0.0)
    moments = lengths * along**4
    moment = np.bincount(polygon, moments.real, count) + 1j * np.bincount(polygon, moments.imag, count)
    straight = np.abs(moment) >= STRAIGHT * np.bincount(polygon, lengths, count)
    return np.where(straight & (moment != 0.0), np.exp(-0.25j * np.angle(moment)), 0.0)


def _nearest_quarter(turn: complex, sides: complex) -> complex:
    """`sides` and so many quarter turns that it comes nearest to `turn`."""
    quarters = round(float(np.angle(turn / sides)) / (0.5 * np.pi))
    return sides * complex(1j**quarters)
