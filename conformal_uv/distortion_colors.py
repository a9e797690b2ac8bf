"""Distortion as colours: perceptual scales of nine colours each, between which it is interpolated."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import OptionError

__all__ = ["angle_colors", "area_colors"]

Real = NDArray[np.float64]

# S. van der Walt, N. Smith, viridis, matplotlib 1.5, 2015 (CC0).
VIRIDIS = "440154 472d7b 3b528b 2c728e 21918c 28ae80 5ec962 addc30 fde725"
# K. Moreland, "Diverging color maps for scientific visualization", ISVC 2009: smooth cool-warm.
COOL_WARM = "3b4cc0 6282ea 8db0fe b9d0f9 dddcdc f5c4ac f4987a dd5f4b b40426"


def angle_colors(error: ArrayLike, most: float = 10.0) -> Real:
    """Angle errors from 0 to `most` degrees, dark violet to yellow (viridis).

    Returns
    -------
    (n, 3) float64
        sRGB, 0 to 1.

    Raises
    ------
    OptionError

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> cuv.angle_colors([0.0, 90.0]).round(2).tolist()
    [[0.27, 0.0, 0.33], [0.99, 0.91, 0.15]]
    """
    if not most > 0.0:
        raise OptionError(f"most is {most}; pass a positive number of degrees.")
    return _scale(VIRIDIS, np.asarray(error, dtype=np.float64) / most)


def area_colors(scale: ArrayLike, most: float = 2.0) -> Real:
    """Area scales from 1 / `most` to `most`, by their logarithms, blue over grey (1) to red (cool-warm).

    Returns
    -------
    (n, 3) float64
        sRGB, 0 to 1.

    Raises
    ------
    OptionError

    Examples
    --------
    >>> import conformal_uv as cuv
    >>> cuv.area_colors([0.0, 1.0, 9.0]).round(2).tolist()
    [[0.23, 0.3, 0.75], [0.87, 0.86, 0.86], [0.71, 0.02, 0.15]]
    """
    if not most > 1.0:
        raise OptionError(f"most is {most}; pass a factor above 1.")
    with np.errstate(divide="ignore"):
        return _scale(COOL_WARM, 0.5 + 0.5 * np.log(np.asarray(scale, dtype=np.float64)) / np.log(most))


def _scale(table: str, part: Real) -> Real:
    """Colours (n, 3) at parts (n,) of a scale; beyond its ends those of the ends."""
    colors = np.array([list(bytes.fromhex(color)) for color in table.split()]) / 255.0
    place = np.clip(np.nan_to_num(part), 0.0, 1.0) * (len(colors) - 1)
    return np.stack([np.interp(place, np.arange(len(colors)), channel) for channel in colors.T], axis=-1)
