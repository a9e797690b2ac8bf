"""A checker image: squares stay square where a map keeps angles."""

from __future__ import annotations

from os import PathLike

import numpy as np

from conformal_uv import MissingDependencyError
from conformal_uv.files import replaced_file

__all__ = ["write_checker"]


def write_checker(path: str | PathLike[str], *, size: int = 1024, squares: int = 32) -> None:
    """Write a checker as a PNG, light and dark squares that turn from blue to orange along u and grow lighter along v.

    Parameters
    ----------
    path : path-like
        The file; it is replaced in one step.
    size : int
        Pixels along a side.
    squares : int
        Squares along a side; they should divide `size`.

    Raises
    ------
    MissingDependencyError
        Pillow is not installed.
    FileFormatError
        The file can not be written.
    """
    try:
        from PIL import Image
    except ImportError as error:
        raise MissingDependencyError('A checker needs Pillow: pip install "conformal-uv[meshlab]".') from error
    t = np.arange(size) / size
    cell = (t * squares).astype(np.int64)
    dark = (cell[:, None] + cell[None, :]) % 2 == 1
    blue, orange = np.array([90.0, 150.0, 225.0]), np.array([245.0, 165.0, 80.0])
    colour = blue + t[None, :, None] * (orange - blue)
    colour = colour + 0.35 * (1.0 - t)[:, None, None] * (255.0 - colour)
    colour[dark] *= 0.45
    with replaced_file(path) as out:
        Image.fromarray(colour.round().astype(np.uint8)).save(out, format="PNG")
