"""Complex derivatives of piecewise linear maps, and the energies made of them.

In complex coordinates p of a triangle's plane and q of its image, with e_k the edge opposite to corner k,
``f_z = -i sum_k q_k conj(e_k) / (4 A)`` and ``f_zbar = i sum_k q_k e_k / (4 A)``. The singular values of the map
are ``|f_z| + |f_zbar|`` and ``||f_z| - |f_zbar||``; it keeps angles where f_zbar = 0.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.blocks import by_blocks
from ..mesh.geometry import TriangleGeometry

__all__ = [
    "conformal_energy",
    "enclosed_area",
    "planar_sides",
    "signed_double_areas",
    "unfolded_sides",
    "wirtinger",
]

Complex = NDArray[np.complex128]
Sides = tuple[Complex, Complex]


def planar_sides(z: Complex, corners: NDArray[np.int32]) -> Sides:
    """The edges from corner 0 to corners 1 and 2 of each face, as complex numbers."""
    origin = z[corners[0]]
    return z[corners[1]] - origin, z[corners[2]] - origin


def unfolded_sides(geometry: TriangleGeometry) -> Sides:
    """The same of triangles in space, each laid into its own plane with corner 1 on the positive axis.

    Where corners 0 and 1 coincide the other edge takes the axis.
    """
    length = np.sqrt(np.maximum(geometry.dot[0] + geometry.dot[1], 0.0))
    second = np.sqrt(np.maximum(geometry.dot[0] + geometry.dot[2], 0.0)).astype(np.complex128)
    np.divide(geometry.dot[0] + 1j * geometry.double_area, length, out=second, where=length > 0)
    return length.astype(np.complex128), second


def signed_double_areas(sides: Sides) -> NDArray[np.float64]:
    """Twice the signed area of plane triangles, (m,)."""
    first, second = sides
    return first.real * second.imag - first.imag * second.real


def wirtinger(source: Sides, image: Sides, double_area: NDArray[np.float64]) -> tuple[Complex, Complex]:
    """(f_z, f_zbar) of the linear map of each triangle, double_area that of the source."""
    (p1, p2), (q1, q2) = source, image
    scale = 0.5j / double_area
    return -scale * (q2 * p1.conj() - q1 * p2.conj()), scale * (q2 * p1 - q1 * p2)


def conformal_energy(geometry: TriangleGeometry, z: Complex, corners: NDArray[np.int32]) -> float:
    """Dirichlet energy minus signed area of the image: ``sum_f 2 A |f_zbar|^2``, without cancellation.

    (Levy, Petitjean, Ray, Maillot 2002, section 2; Mullen, Tong, Alliez, Desbrun 2008, eq. 2.)
    """

    def energy(part: slice) -> float:
        here = geometry.part(part)
        p1, p2 = unfolded_sides(here)
        q1, q2 = planar_sides(z, corners[:, part])
        residual = q2 * p1 - q1 * p2
        return float(((residual.real**2 + residual.imag**2) / (4.0 * here.double_area)).sum())

    return sum(by_blocks(energy, corners.shape[1]), 0.0)


def enclosed_area(z: Complex) -> float:
    """Signed area inside a closed polygon (k,): that of all the faces it is the boundary of, in a map to the plane."""
    return 0.5 * float(np.imag(np.vdot(z, np.roll(z, -1))))
