"""Arrays of numbers as few bytes: whole steps of a grid, their differences from row to row, byte planes."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["PackedArray", "packed_integers", "packed_reals"]


@dataclass(frozen=True, eq=False)
class PackedArray:
    """An array (rows, columns); element q of `data` stands for ``low[column] + q step``.

    Attributes
    ----------
    width : int
        Bytes of each number.
    """

    name: str
    rows: int
    columns: int
    width: int
    low: list[float]
    step: float
    data: bytes

    def header(self) -> dict[str, Any]:
        """All but the data."""
        return {key: value for key, value in asdict(self).items() if key != "data"}


def packed_reals(
    name: str, values: NDArray[np.floating], width: int, *, within: tuple[float, float] | None = None
) -> PackedArray:
    """Real numbers (n,) or (n, c), rounded to the steps of a grid of 2^(8 width) points.

    Parameters
    ----------
    within : (low, high), optional
        What the grid covers; by default the values of each column, in steps of one length.
    """
    table = np.asarray(values, dtype=np.float64).reshape(len(values), -1)
    low, high = table.min(axis=0), table.max(axis=0)
    if within is not None:
        low, high = np.full(table.shape[1], within[0]), np.full(table.shape[1], within[1])
    most = 2 ** (8 * width) - 1
    step = float((high - low).max()) / most or 1.0
    steps = np.clip(np.rint((table - low) / step), 0, most).astype(np.int64)
    rows, columns = table.shape
    return PackedArray(name, rows, columns, width, low.tolist(), step, _coded(steps, width))


def packed_integers(name: str, values: NDArray[np.integer]) -> PackedArray:
    """Whole numbers (n, c) from 0 to 2^32 - 1."""
    table = np.asarray(values, dtype=np.int64)
    width = max(1, (int(table.max(initial=0)).bit_length() + 7) // 8)
    rows, columns = table.shape
    return PackedArray(name, rows, columns, width, [0.0] * columns, 1.0, _coded(table, width))


def _coded(table: NDArray[np.int64], width: int) -> bytes:
    """Differences modulo 2^(8 width), near 0 on either side (0, -1, 1, -2 ... as 0, 1, 2, 3 ...); column after column,
    in each the lowest bytes of all rows, then the next."""
    half, full = 1 << (8 * width - 1), 1 << (8 * width)
    steps = (np.diff(table, axis=0, prepend=0) + half) % full - half
    near = ((steps << 1) ^ (steps >> 63)).astype("<u4")
    planes = np.ascontiguousarray(near.T).view(np.uint8).reshape(*near.T.shape, 4)[:, :, :width]
    return np.ascontiguousarray(planes.transpose(0, 2, 1)).tobytes()
