"""The directions in which the boundary angles may move: the gauge kept, linked neighbours together."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .gauge import Gauge

__all__ = ["Tangent"]

Real = NDArray[np.float64]


class Tangent:
    """Orthogonal projection onto the free directions at one vector of angles, and a preconditioner on them.

    Parameters
    ----------
    gauge : Gauge
    theta : (nb,) float64
    links : (nb,) bool
        Link k holds vertices k and k + 1 (the last one the last and the first) at their distance.
    inverse : callable
        About the inverse of the Hessian, symmetric and positive definite.
    """

    def __init__(self, gauge: Gauge, theta: Real, links: NDArray[np.bool_], inverse: Callable[[Real], Real]) -> None:
        self.links, self.inverse = links, inverse
        if links.any():  # chains of linked vertices, numbered from behind a gap
            self._turn = int(np.flatnonzero(~links)[0]) + 1
            self._chain = np.cumsum(~np.roll(links, 1 - self._turn))
            self._count = np.maximum(np.bincount(self._chain), 1)
        normals = np.column_stack([self._mean(column) for column in gauge.normals(theta).T])
        basis, size, _ = np.linalg.svd(normals, full_matrices=False)
        self._basis = basis[:, size > 1e-12 * size.max(initial=0.0)]  # links can leave fewer than there were

    def project(self, direction: Real) -> Real:
        """Orthogonal projection."""
        linked = self._mean(direction)
        return linked - self._basis @ (self._basis.T @ linked)

    def precondition(self, residual: Real) -> Real:
        """The free direction d that minimises 1/2 d' M d - residual' d, M the preconditioner."""
        free = self._smooth(residual)
        held = free - self._image @ np.linalg.solve(self._basis.T @ self._image, self._basis.T @ free)
        return self.project(held)  # once more, against rounding

    def pull_of_links(self, gradient: Real) -> Real:
        """Multiplier of every link, (nb,), 0 elsewhere: negative where letting go would part the two.

        It is minus the sum of the gradient over the vertices of its chain up to the link.
        """
        if not self.links.any():
            return np.zeros_like(gradient)
        rest = np.roll(gradient - self._basis @ (self._basis.T @ gradient), -self._turn)
        running = np.cumsum(rest)
        first = np.flatnonzero(np.diff(self._chain, prepend=self._chain[0] - 1))
        inside = running - np.repeat(running[first] - rest[first], np.diff(first, append=len(rest)))
        return np.where(self.links, -np.roll(inside, self._turn), 0.0)

    @cached_property
    def _image(self) -> Real:
        return np.column_stack([self._smooth(column) for column in self._basis.T])

    def _smooth(self, residual: Real) -> Real:
        return self._mean(self.inverse(residual))

    def _mean(self, direction: Real) -> Real:
        """Replace each chain of linked entries by its mean."""
        if not self.links.any():
            return direction
        mean = np.bincount(self._chain, weights=np.roll(direction, -self._turn)) / self._count
        return np.roll(mean[self._chain], self._turn)
