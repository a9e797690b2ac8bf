"""Proof that the limit has solved the system it was timed on."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .outcome import Arrays

__all__ = ["worst_residual"]


def worst_residual(arrays: Arrays, x: NDArray[np.float64]) -> float:
    """Largest entry of ``|A x - 1|`` over that of ``|A| |x|``; A symmetric, given by its lower triangle."""
    rows = arrays["indices"]
    columns = np.repeat(np.arange(len(x)), np.diff(arrays["indptr"]))
    below = np.where(rows != columns, arrays["data"], 0.0)
    product = np.bincount(rows, arrays["data"] * x[columns], len(x)) + np.bincount(columns, below * x[rows], len(x))
    size = float((np.abs(arrays["data"]) * np.abs(x[columns])).max())
    return float(np.abs(product - 1.0).max()) / size
