"""Conformal energy of a map to the sphere: Dirichlet energy minus the area of the image polyhedron.

The area of a face counts negative where it is seen inverted from outside, so that folds cost energy.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..operators.edge_laplacian import EdgeLaplacian
from .centring import unit

__all__ = ["SphereEnergy"]

Real = NDArray[np.float64]

TINY = np.finfo(np.float64).tiny


class SphereEnergy:
    """``1/2 tr(X' L X) - area`` at positions X of the unit sphere, its gradient and Hessian along the sphere.

    Attributes
    ----------
    x : (n, 3) float64
    value : float
    gradient : (n, 3) float64
        Tangent to the sphere at every vertex.
    """

    def __init__(self, laplacian: EdgeLaplacian, corners: NDArray[np.int32], x: Real) -> None:
        self.laplacian, self.corners, self.x = laplacian, corners, unit(x)
        a, b, c = (self.x[corner] for corner in corners)
        self._ab, self._ac = b - a, c - a
        normal = np.cross(self._ab, self._ac)
        self._double_area = np.linalg.norm(normal, axis=1)
        self._sign = np.where(np.einsum("ij,ij->i", a, normal) < 0.0, -1.0, 1.0)
        self._normal = normal * (self._sign / np.maximum(self._double_area, TINY))[:, None]
        step = self.x[laplacian.lo] - self.x[laplacian.hi]
        dirichlet = 0.5 * float(laplacian.weights @ np.einsum("ij,ij->i", step, step))
        self.value = dirichlet - 0.5 * float(self._sign @ self._double_area)
        free = self._laplace(self.x) - self._area_gradient(self._normal, self._ab, self._ac)
        self._radial = np.einsum("ij,ij->i", free, self.x)
        self.gradient = free - self._radial[:, None] * self.x

    def hessian_product(self, direction: Real) -> Real:
        """Riemannian Hessian times a tangent direction (n, 3)."""
        a, b, c = (direction[corner] for corner in self.corners)
        ab, ac = b - a, c - a
        change = np.cross(ab, self._ac) + np.cross(self._ab, ac)
        along = np.einsum("ij,ij->i", change, self._normal)
        scale = (self._sign / np.maximum(self._double_area, TINY))[:, None]
        turned = (change - along[:, None] * self._normal) * scale
        area = self._area_gradient(turned, self._ab, self._ac) + self._area_gradient(self._normal, ab, ac)
        return self.tangent(self._laplace(direction) - area) - self._radial[:, None] * direction

    def tangent(self, vectors: Real) -> Real:
        """The part of vectors (n, 3) tangent to the sphere."""
        return vectors - np.einsum("ij,ij->i", vectors, self.x)[:, None] * self.x

    def _laplace(self, x: Real) -> Real:
        lo, hi, n = self.laplacian.lo, self.laplacian.hi, len(self.x)
        flow = self.laplacian.weights[:, None] * (x[lo] - x[hi])
        return _gathered((lo, hi), (flow, -flow), n)

    def _area_gradient(self, normal: Real, ab: Real, ac: Real) -> Real:
        """Half the normal times the opposite edge, gathered at the vertices; bilinear in normal and edges."""
        at_b, at_c = 0.5 * np.cross(ac, normal), 0.5 * np.cross(normal, ab)
        return _gathered(tuple(self.corners), (-at_b - at_c, at_b, at_c), len(self.x))


def _gathered(places: tuple[NDArray[np.int32], ...], values: tuple[Real, ...], n: int) -> Real:
    """Sums (n, 3) of rows at the places."""
    place = np.concatenate(places)
    rows = np.concatenate(values)
    return np.column_stack([np.bincount(place, weights=column, minlength=n) for column in rows.T])
