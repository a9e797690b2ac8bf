"""Very many triangles as samples of a picture, each pixel the mean of several; numpy alone."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["SAMPLES", "faces_in_front", "painted"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Picture = NDArray[np.uint8]

SAMPLES = 4  # a pixel has so many in each direction
TRIANGLES = 1 << 16  # drawn together


def faces_in_front(triangles: Floats, shape: tuple[int, int]) -> NDArray[np.int32]:
    """The last triangle over each sample, -1 for none; sample (i, j) is at x = j + 1/2, y = i + 1/2."""
    faces = np.full(shape, -1, np.int32)
    flat = faces.reshape(-1)
    for begin in range(0, len(triangles), TRIANGLES):
        owner, row, left, right = _spans(triangles[begin : begin + TRIANGLES], shape)
        lengths = right - left
        first = np.cumsum(lengths) - lengths
        at = np.repeat(row * shape[1] + left - first, lengths) + np.arange(int(lengths.sum()))
        flat[at] = np.repeat((owner + begin).astype(np.int32), lengths)  # where one comes twice, the last stays
    return faces


def _spans(triangles: Floats, shape: tuple[int, int]) -> tuple[Ints, Ints, Ints, Ints]:
    """Every row of samples in every triangle: whose it is, the row, and the samples from left to right."""
    low, middle, high = _by_height([np.ascontiguousarray(triangles[:, k].T) for k in range(3)])
    first, behind = _first_sample(low[1], shape[0]), _first_sample(high[1], shape[0])
    rows = behind - first
    owner = np.repeat(np.arange(len(triangles)), rows)
    row = np.arange(len(owner)) - np.repeat(np.cumsum(rows) - rows - first, rows)
    y = row + 0.5
    long, below, above = (_crossings(*edge, owner, y) for edge in ((low, high), (low, middle), (middle, high)))
    short = np.where(y < middle[1][owner], below, above)
    left, right = (_first_sample(x, shape[1]) for x in (np.minimum(long, short), np.maximum(long, short)))
    some = np.flatnonzero(right > left)
    return owner[some], row[some], left[some], right[some]


def _by_height(corners: list[Floats]) -> list[Floats]:
    """The three corners (x, y) of every triangle, from the lowest to the highest."""
    for a, b in ((0, 1), (1, 2), (0, 1)):
        swap = corners[a][1] > corners[b][1]
        corners[a], corners[b] = np.where(swap, corners[b], corners[a]), np.where(swap, corners[a], corners[b])
    return corners


def _first_sample(x: Floats, count: int) -> Ints:
    """The first of so many samples that is not before x."""
    return np.clip(np.ceil(x - 0.5), 0, count).astype(np.int64)


def _crossings(low: Floats, high: Floats, owner: Ints, y: Floats) -> Floats:
    """Where edges cross horizontal lines."""
    rise = high[1] - low[1]
    slope = (high[0] - low[0]) / np.where(rise > 0, rise, 1.0)
    return (low[0] - slope * low[1])[owner] + slope[owner] * y


def painted(faces: NDArray[np.int32], colours: Floats) -> Picture:
    """The samples' mean colours, (h, w, 4) from the lowest row up; a pixel is as opaque as samples have a face."""
    table = np.zeros((len(colours) + 1, 4), np.uint8)
    table[:-1] = 255 * np.clip(colours * np.where([1, 1, 1, 0], colours[:, 3:], 1.0), 0.0, 1.0) + 0.5
    packed = table.view(np.uint32).ravel()
    sums = np.zeros((faces.shape[0] // SAMPLES, faces.shape[1] // SAMPLES, 4), np.uint16)
    for i in range(SAMPLES):
        for j in range(SAMPLES):
            some = packed[faces[i::SAMPLES, j::SAMPLES]]
            sums += some.view(np.uint8).reshape(sums.shape)
    opaque = np.maximum(sums[:, :, 3:], 1) / 255
    picture = np.concatenate([sums[:, :, :3] / opaque, sums[:, :, 3:] / SAMPLES**2], axis=2)
    return (picture + 0.5).astype(np.uint8)
