"""Truncated conjugate gradients, as `optimize.truncated_cg`, on many small systems at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..optimize.truncated_cg import FLAT, MOST_STEPS

__all__ = ["truncated_cg_rows"]

Real = NDArray[np.float64]
Ints = NDArray[np.int64]


def truncated_cg_rows(gradient: Real, H: Real, precondition: Callable[[Real, Ints], Real], goal: Real) -> Real:
    """Directions (r, k) with ``H d = -gradient`` to residuals of norm `goal` (r,), each ended where the energy does not
    rise along a direction of search.

    Parameters
    ----------
    gradient : (r, k) float64
    H : (r, k, k) float64
    precondition : callable
        Of residuals (q, k) of some rows and the numbers (q,) of these.
    """
    direction, residual = np.zeros_like(gradient), -gradient
    left = np.arange(len(gradient))
    search = precondition(residual, left)
    product = np.einsum("rk,rk->r", residual, search)
    for step in range(1, MOST_STEPS + 1):
        image = np.einsum("rkl,rl->rk", H[left], search)
        curvature = np.einsum("rk,rk->r", search, image)
        flat = curvature <= FLAT * product
        if step == 1:
            direction[left[flat]] = search[flat]
        left, search, image, product = left[~flat], search[~flat], image[~flat], product[~flat]
        length = (product / curvature[~flat])[:, None]
        direction[left] += length * search
        residual[left] -= length * image
        open_ = np.linalg.norm(residual[left], axis=1) > goal[left]
        left, search, product = left[open_], search[open_], product[open_]
        if not len(left):
            break
        smooth = precondition(residual[left], left)
        after = np.einsum("rk,rk->r", residual[left], smooth)
        seen = product > 0.0
        search = smooth[seen] + (after / np.where(seen, product, 1.0))[seen, None] * search[seen]
        left, product = left[seen], after[seen]
        if not len(left):
            break
    return direction
