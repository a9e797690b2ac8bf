"""Moebius maps of the unit sphere, as Lorentz transformations.

A point x of the sphere stands for the ray of (1, x) in the light cone; a linear map of space-time that keeps the cone
and its orientation takes rays to rays, and that is a conformal map of the sphere onto itself. Rotations and boosts
generate all of them, and each is one boost after one rotation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import OptionError

__all__ = ["SphereMoebius"]

Real = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SphereMoebius:
    """A conformal map of the unit sphere onto itself.

    Attributes
    ----------
    matrix : (4, 4) float64
        Acts on (1, x, y, z).

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> turned = cuv.SphereMoebius.rotation_to([1, 0, 0], [0, 0, 1])
    >>> turned([[1, 0, 0], [0, 1, 0]]).round(12).tolist()
    [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]
    """

    matrix: Real

    def __call__(self, xyz: ArrayLike) -> Real:
        """Images of points (n, 3)."""
        x = np.asarray(xyz, dtype=np.float64)
        moved = x @ self.matrix[1:, 1:].T
        moved += self.matrix[1:, 0]
        moved /= np.sqrt(np.einsum("ij,ij->i", moved, moved))[:, None]
        return moved

    def __matmul__(self, other: SphereMoebius) -> SphereMoebius:
        """The map that applies `other` first."""
        return SphereMoebius(self.matrix @ other.matrix)

    def inverse(self) -> SphereMoebius:
        """The map that undoes this one."""
        flip = np.diag([-1.0, 1.0, 1.0, 1.0])
        return SphereMoebius(flip @ self.matrix.T @ flip)

    @classmethod
    def of(cls, toward: ArrayLike = (0.0, 0.0, 0.0), rotation: ArrayLike | None = None) -> SphereMoebius:
        """A rotation (3, 3), and then a boost: all points move toward a direction, the farther the longer it is.

        Parameters
        ----------
        toward : (3,) floats
            Shorter than 1. What lies opposite becomes larger by ``sqrt((1 + t) / (1 - t))``, t its length.

        Raises
        ------
        OptionError
            The vector is not shorter than 1.
        """
        velocity = np.asarray(toward, dtype=np.float64)
        square = float(velocity @ velocity)
        if not square < 1.0:
            raise OptionError(
                f"The direction {velocity.tolist()} is not shorter than 1; no map of the sphere is meant."
            )
        gamma = 1.0 / np.sqrt(1.0 - square)
        boost = np.empty((4, 4))
        boost[0, 0] = gamma
        boost[0, 1:] = boost[1:, 0] = gamma * velocity
        boost[1:, 1:] = np.eye(3) + gamma**2 / (1.0 + gamma) * np.outer(velocity, velocity)
        turn = np.eye(4)
        if rotation is not None:
            turn[1:, 1:] = rotation
        return cls(boost @ turn)

    @classmethod
    def rotation_to(cls, p: ArrayLike, q: ArrayLike) -> SphereMoebius:
        """The rotation along a great circle that takes the unit vector p to q."""
        a, b = np.asarray(p, dtype=np.float64), np.asarray(q, dtype=np.float64)
        axis, cosine = np.cross(a, b), float(a @ b)
        if cosine < -1.0 + 1e-12:
            other = np.eye(3)[np.argmin(np.abs(a))]
            axis = np.cross(a, other)
            axis /= np.linalg.norm(axis)
            return cls.of(rotation=2.0 * np.outer(axis, axis) - np.eye(3))
        cross = np.array([[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
        return cls.of(rotation=np.eye(3) + cross + cross @ cross / (1.0 + cosine))

    def toward_and_rotation(self) -> tuple[Real, Real]:
        """What `of` makes this map of: the boost's direction (3,), and the rotation (3, 3) before it."""
        toward = self.matrix[1:, 0] / self.matrix[0, 0]
        rest = SphereMoebius.of(toward).inverse() @ self
        left, _, right = np.linalg.svd(rest.matrix[1:, 1:])
        return toward, left @ right
