"""Lists of any lengths as the bytes of a binary PLY file."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["gathered", "packed"]

Ints = NDArray[np.int64]

FEW = 16


def gathered(data: bytes, starts: Ints, lengths: Ints, kind: str) -> NDArray[Any]:
    """The values that begin at these places, so many at each, run together."""
    width = np.dtype(kind).itemsize
    found = np.empty(int(lengths.sum()), kind)
    targets = (np.cumsum(lengths) - lengths) * width
    for length, rows in _alike(lengths):
        size = length * width
        _windows(found, found.nbytes, size)[targets[rows]] = _windows(data, len(data), size)[starts[rows]]
    return found


def packed(values: NDArray[Any], lengths: Ints, length_kind: str, kind: str) -> tuple[NDArray[np.uint8], Ints]:
    """Each list as its length and its values: the bytes run together, and how many each list takes."""
    values = values.astype(kind)
    head, width = np.dtype(length_kind).itemsize, np.dtype(kind).itemsize
    sizes = head + width * lengths
    raw = np.empty(int(sizes.sum()), np.uint8)
    targets, starts = np.cumsum(sizes) - sizes, (np.cumsum(lengths) - lengths) * width
    if len(lengths):
        _windows(raw, len(raw), head)[targets] = lengths.astype(length_kind).view(f"V{head}")
    for length, rows in _alike(lengths):
        size = length * width
        _windows(raw, len(raw), size)[targets[rows] + head] = _windows(values, values.nbytes, size)[starts[rows]]
    return raw, sizes


def _alike(lengths: Ints) -> list[tuple[int, Ints]]:
    """The lengths that there are, but for 0, and the lists that have them."""
    different = np.unique(lengths)
    if len(different) <= FEW:
        groups = [np.flatnonzero(lengths == n) for n in different]
    else:
        groups = np.split(np.argsort(lengths, kind="stable"), np.searchsorted(np.sort(lengths), different[1:]))
    return [(n, rows) for n, rows in zip(different.tolist(), groups, strict=True) if n]


def _windows(buffer: Any, size: int, length: int) -> NDArray[Any]:
    """Every stretch of so many bytes, by where it begins."""
    return np.ndarray(size - length + 1, f"V{length}", buffer, strides=(1,))
