"""Conformal energy of a map to the sphere: Dirichlet energy minus the area of the image polyhedron.

The area of a face counts negative where it is seen inverted from outside, so that folds cost energy.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..operators.edge_laplacian import EdgeLaplacian
from ..operators.orientation_sign import outward_signs
from .centring import unit

__all__ = ["SphereEnergy", "area_gradient", "area_hessian_product", "laplace", "triangle_normals"]

Real = NDArray[np.float64]

TINY = np.finfo(np.float64).tiny


def triangle_normals(x: Real, corners: NDArray[np.int32]) -> tuple[Real, Real, Real, Real]:
    """Doubled areas (m,), unit normals (m, 3), and the edges (m, 3) from corner 0 to corners 1 and 2."""
    a, b, c = (x[corner] for corner in corners)
    ab, ac = b - a, c - a
    normal = _cross(ab, ac)
    double_area = np.linalg.norm(normal, axis=1)
    return double_area, normal / np.maximum(double_area, TINY)[:, None], ab, ac


def laplace(laplacian: EdgeLaplacian, x: Real) -> Real:
    """L x for rows (n, 3)."""
    flow = laplacian.weights[:, None] * (x[laplacian.lo] - x[laplacian.hi])
    return _gathered((laplacian.lo, laplacian.hi), (flow, -flow), len(x))


def area_gradient(corners: NDArray[np.int32], normal: Real, ab: Real, ac: Real, n: int) -> Real:
    """Half the normal times the opposite edge, gathered at the vertices (n, 3); bilinear in normal and edges."""
    at_b, at_c = 0.5 * _cross(ac, normal), 0.5 * _cross(normal, ab)
    return _gathered(tuple(corners), (-at_b - at_c, at_b, at_c), n)


def area_hessian_product(
    corners: NDArray[np.int32], signed_area: Real, normal: Real, ab: Real, ac: Real, direction: Real
) -> Real:
    """Hessian of the area times a direction (n, 3); `signed_area` is the doubled area with the sign of the normal."""
    a, b, c = (direction[corner] for corner in corners)
    d_ab, d_ac = b - a, c - a
    change = _cross(d_ab, ac) + _cross(ab, d_ac)
    along = np.einsum("ij,ij->i", change, normal)
    scale = np.sign(signed_area) / np.maximum(np.abs(signed_area), TINY)
    turned = (change - along[:, None] * normal) * scale[:, None]
    n = len(direction)
    return area_gradient(corners, turned, ab, ac, n) + area_gradient(corners, normal, d_ab, d_ac, n)


def _cross(p: Real, q: Real) -> Real:
    """Vector products of rows (m, 3); numpy's makes more temporaries."""
    out = np.empty_like(p)
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        np.multiply(p[:, i], q[:, j], out=out[:, k])
        out[:, k] -= p[:, j] * q[:, i]
    return out


class SphereEnergy:
    """``1/2 tr(X' L X) - area`` at positions X of the unit sphere, its gradient and Hessian along the sphere.

    The area is that of the triangles whose Laplacian L is, be they the surface's own or intrinsic ones: only of the
    same triangles is it at most the Dirichlet energy.

    Attributes
    ----------
    x : (n, 3) float64
    value : float
    sound : (m,) or (2 m,) bool
        The faces that are anticlockwise seen from outside, exactly; the intrinsic triangles after them.
    gradient : (n, 3) float64
        Tangent to the sphere at every vertex.
    """

    def __init__(self, laplacian: EdgeLaplacian, corners: NDArray[np.int32], x: Real) -> None:
        self.laplacian, self.faces, self.x = laplacian, corners, unit(x)
        self.corners = corners = corners if laplacian.corners is None else laplacian.corners
        self._double_area, normal, self._ab, self._ac = triangle_normals(self.x, corners)
        signs = outward_signs(self.x, corners)
        self.sound: NDArray[np.bool_] = signs > 0
        if corners is not self.faces:
            self.sound = np.concatenate((outward_signs(self.x, self.faces) > 0, self.sound))
        self._sign = np.where(signs < 0, -1.0, 1.0)
        self._normal = normal * self._sign[:, None]
        step = self.x[laplacian.lo] - self.x[laplacian.hi]
        dirichlet = 0.5 * float(laplacian.weights @ np.einsum("ij,ij->i", step, step))
        self.value = dirichlet - 0.5 * float(self._sign @ self._double_area)
        free = laplace(laplacian, self.x) - area_gradient(corners, self._normal, self._ab, self._ac, len(x))
        self._radial = np.einsum("ij,ij->i", free, self.x)
        self.gradient = free - self._radial[:, None] * self.x

    def vertices_of(self, faces: NDArray[np.int64]) -> NDArray[np.int64]:
        """The vertices of faces numbered as in `sound`."""
        both = self.faces if self.corners is self.faces else np.concatenate((self.faces, self.corners), axis=1)
        return np.unique(both[:, faces]).astype(np.int64)

    def hessian_product(self, direction: Real) -> Real:
        """Riemannian Hessian times a tangent direction (n, 3)."""
        signed = self._sign * self._double_area
        area = area_hessian_product(self.corners, signed, self._normal, self._ab, self._ac, direction)
        return self.tangent(laplace(self.laplacian, direction) - area) - self._radial[:, None] * direction

    def tangent(self, vectors: Real) -> Real:
        """The part of vectors (n, 3) tangent to the sphere."""
        return vectors - np.einsum("ij,ij->i", vectors, self.x)[:, None] * self.x


def _gathered(places: tuple[NDArray[np.int32], ...], values: tuple[Real, ...], n: int) -> Real:
    """Sums (n, 3) of rows at the places."""
    place = np.concatenate(places)
    rows = np.concatenate(values)
    return np.column_stack([np.bincount(place, weights=column, minlength=n) for column in rows.T])
