"""Moebius maps of the plane and of the unit disk."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import OptionError

__all__ = ["Moebius", "centring_step", "turned_angles"]

Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class Moebius:
    """``z -> (a z + b) / (c z + d)``.

    Attributes
    ----------
    a, b, c, d : complex
        With ``a d - b c != 0``.

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> import numpy as np
    >>> moved = cuv.Moebius.to_zero(0.5j, 1.0)(np.array([0.5j, 1.0]))
    >>> moved.round(12).tolist()
    [0j, (1+0j)]
    """

    a: complex
    b: complex
    c: complex
    d: complex

    def __call__(self, z: ArrayLike) -> Complex:
        """Images of complex numbers of any shape."""
        w = np.asarray(z, dtype=np.complex128)
        over, under = self.a * w, self.c * w
        over += self.b
        under += self.d
        over /= under
        return over

    def __matmul__(self, other: Moebius) -> Moebius:
        """The map that applies `other` first."""
        return Moebius(
            self.a * other.a + self.b * other.c,
            self.a * other.b + self.b * other.d,
            self.c * other.a + self.d * other.c,
            self.c * other.b + self.d * other.d,
        )

    def inverse(self) -> Moebius:
        """The map that undoes this one."""
        return Moebius(self.d, -self.b, -self.c, self.a)

    @classmethod
    def to_zero(cls, p: complex, to_one: complex | None = None) -> Moebius:
        """The map of the unit disk onto itself that sends p to 0 and, where given, the boundary point to 1.

        Raises
        ------
        OptionError
            p is not inside the disk.
        """
        if not abs(p) < 1.0:
            raise OptionError(f"The point {p} is not inside the unit disk; no map of the disk sends it to 0.")
        shift = cls(1.0, -p, -np.conj(p), 1.0)
        if to_one is None:
            return shift
        turn = np.conj(complex(shift(to_one)))
        turn /= abs(turn)
        return cls(turn, -turn * p, -np.conj(p), 1.0)

    @classmethod
    def of_disk(cls, center: complex = 0.0, rotation: float = 0.0) -> Moebius:
        """The map of the unit disk onto itself that turns about 0 by an angle (radians), then sends 0 to `center`.

        Every orientation-preserving conformal map of the disk onto itself is one of these; see `center_and_rotation`.

        Raises
        ------
        OptionError
            The center is not inside the disk.
        """
        turn = complex(np.exp(1j * rotation))
        return cls.to_zero(center).inverse() @ cls(turn, 0.0, 0.0, 1.0)

    @classmethod
    def disk_translation(cls, p: complex, q: complex) -> Moebius:
        """The hyperbolic translation of the unit disk that moves p to q along the geodesic through both.

        Raises
        ------
        OptionError
            A point is not inside the disk.
        """
        there = cls.to_zero(p)
        cls.to_zero(q)
        return there.inverse() @ cls.of_disk(complex(there(q))) @ there

    def center_and_rotation(self) -> tuple[complex, float]:
        """Of a map of the disk onto itself: the image of 0, and the angle (radians) by which directions at 0 turn."""
        slope = (self.a * self.d - self.b * self.c) / self.d**2
        return complex(self.b / self.d), float(np.angle(slope))

    @classmethod
    def from_three_pairs(cls, z: ArrayLike, w: ArrayLike) -> Moebius:
        """The map with ``z[k] -> w[k]`` for k = 0, 1, 2; of the disk when all lie on the circle in one order.

        Raises
        ------
        OptionError
            Not three pairs of finite numbers, or two points of one triple coincide.
        """
        sources, targets = (np.asarray(x, dtype=np.complex128).reshape(-1) for x in (z, w))
        for points in (sources, targets):
            if len(points) != 3 or not np.isfinite(points).all() or len(np.unique(points)) < 3:
                raise OptionError(f"Three different points are needed to fix a Moebius map; got {points}.")
        return cls._to_zero_one_infinity(targets).inverse() @ cls._to_zero_one_infinity(sources)

    @classmethod
    def _to_zero_one_infinity(cls, p: Complex) -> Moebius:
        up, down = complex(p[1] - p[2]), complex(p[1] - p[0])
        return cls(up, -up * complex(p[0]), down, -down * complex(p[2]))

    def disk_centre(self) -> complex:
        """The point that is sent to 0."""
        return -self.b / self.a


def turned_angles(theta: NDArray[np.float64], a: complex) -> NDArray[np.float64]:
    """Angles of the points exp(i theta) after the map of the disk that sends a to 0 and keeps directions at a.

    A continuous increasing function of theta: order and winding stay as they are.
    """
    return theta + 2.0 * np.angle(1.0 - a * np.exp(-1j * theta))


def centring_step(z: Complex, weights: NDArray[np.float64]) -> complex:
    """Newton's step for the point a whose map to 0 makes the weighted mean of the circle points z vanish.

    The mean of M_a(z) is ``s - a + conj(a) q`` to first order, s and q the means of z and z^2; weights sum to 1.
    """
    s, q = complex(weights @ z), complex(weights @ (z * z))
    step = (s + q * np.conj(s)) / max(1.0 - abs(q) ** 2, 1e-3)
    return step / max(1.0, 2.0 * abs(step))
