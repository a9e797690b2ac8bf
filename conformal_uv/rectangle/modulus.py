"""The conformal modulus of a quadrilateral, and what encloses it.

A surface of triangles is a surface with a conformal structure of its own. On it, the least Dirichlet energy of
functions that are 0 and 1 on two opposite sides is 1 / M for the one pair of sides and M for the other, M the modulus.
Whatever is piecewise linear has at least that energy, so M lies between 1 / E_u and E_v.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.surface import Surface
from ..operators.edge_laplacian import EdgeLaplacian, cotan_edges
from ..operators.mollification import mollified

__all__ = ["enclosure", "modulus"]

Real = NDArray[np.float64]

ROUNDING = 2.0**-40  # of the terms of the energy, for that of the weights


def modulus(laplacian: EdgeLaplacian, u: Real, v: Real) -> float:
    """The best guess: the square root of E_v / E_u, in which what both have too much cancels."""
    return float(np.sqrt(_energy(laplacian, v)[0] / _energy(laplacian, u)[0]))


def enclosure(surface: Surface, laplacian: EdgeLaplacian, u: Real, v: Real) -> tuple[float, float]:
    """Numbers that the modulus lies between, u and v being 0 and 1 on the sides.

    The weights must be those of triangles that make up the surface itself, as the cotangents and those of the intrinsic
    Delaunay triangulation are, but on mollified lengths. There the energies of the triangles as they are tell; where
    one of these has no area, nothing does, and the numbers are 0 and infinity.
    """
    if laplacian.kind != "cotan":
        lengths = np.sqrt(np.maximum(surface.geometry.squared_lengths, 0.0))
        if len(surface.degenerate):
            return 0.0, float("inf")
        if mollified(lengths) is not lengths:
            laplacian = cotan_edges(surface.edges, surface.geometry)
    (low, low_error), (high, high_error) = _energy(laplacian, u), _energy(laplacian, v)
    return 1.0 / (low + low_error), high + high_error


def _energy(laplacian: EdgeLaplacian, x: Real) -> tuple[float, float]:
    """``x' L x`` and a bound on its rounding."""
    square = (x[laplacian.lo] - x[laplacian.hi]) ** 2
    return float(laplacian.weights @ square), ROUNDING * float(np.abs(laplacian.weights) @ square)
