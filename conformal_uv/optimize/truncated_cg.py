"""Newton directions by preconditioned conjugate gradients that stop early.

T. Steihaug, "The conjugate gradient method and trust regions in large scale optimization", 1983.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

__all__ = ["truncated_cg"]

Real = NDArray[np.float64]

MOST_STEPS = 200
FLAT = 1e-12  # curvature, in the preconditioner's norm, below which the energy does not rise along a direction


def truncated_cg(
    gradient: Real,
    hessian_product: Callable[[Real], Real],
    precondition: Callable[[Real], Real],
    goal: float,
    watch: Callable[[], None] = lambda: None,
) -> tuple[Real, int]:
    """A direction d with ``H d = -gradient`` to a residual of norm `goal`, and the steps it took.

    Where the energy does not rise along a direction of search, it is what was found before; the preconditioned
    gradient if that is the first.

    Parameters
    ----------
    gradient : (k,) or (k, d) float64
        In the space of free directions, as are all products with H and with the preconditioner.
    watch : callable, optional
        Called before every step; what it raises ends the work.
    """
    direction = np.zeros_like(gradient)
    residual = -gradient
    smooth = precondition(residual)
    search, product = smooth, float(np.vdot(residual, smooth))
    for step in range(1, MOST_STEPS + 1):
        watch()
        image = hessian_product(search)
        curvature = float(np.vdot(search, image))
        if curvature <= FLAT * product:
            return (direction if step > 1 else smooth), step
        length = product / curvature
        direction = direction + length * search
        residual = residual - length * image
        if np.linalg.norm(residual) <= goal:
            break
        smooth = precondition(residual)
        product, previous = float(np.vdot(residual, smooth)), product
        if not previous > 0.0:  # nothing is left that the preconditioner can see
            break
        search = smooth + (product / previous) * search
    return direction, step
