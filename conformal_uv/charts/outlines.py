"""Charts as they are to be packed: positions in their planes and the triangles that cover them, all in one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

__all__ = ["Outlines", "chart_outlines", "disk_outlines", "joint_outlines", "unit_disk"]

DISK_SIDES = 64  # of the polygon around a disk: 0.1 % too far out at its corners
MANY_DISKS = 2000  # from here on a disk is as good as the square around it


@dataclass(frozen=True, eq=False)
class Outlines:
    """The shapes of k charts, their boxes' lower left corners in 0.

    Attributes
    ----------
    z : (n,) complex128
        Positions, chart after chart.
    corners : (3, m) int64
        Triangles, chart after chart; every position of a chart without triangles is one.
    owner : (m,) int64
        The chart of each triangle.
    low : (k,) complex128
        Where the boxes' corners were.
    size : (k,) complex128
        Width and height of the boxes.
    """

    z: NDArray[np.complex128]
    corners: NDArray[np.int64]
    owner: NDArray[np.int64]
    low: NDArray[np.complex128]
    size: NDArray[np.complex128]

    def __len__(self) -> int:
        return len(self.size)

    def scaled(self, scale: NDArray[np.float64]) -> Outlines:
        """Each chart (k,) as many times as large."""
        point = np.ones(len(self.z))  # those of no triangle do not matter
        point[self.corners] = scale[self.owner]
        return replace(self, z=self.z * point, low=self.low * scale, size=self.size * scale)

    def positions(self) -> list[NDArray[np.complex128]]:
        """Of each chart's triangles."""
        return np.split(self.z[self.corners].T.reshape(-1), 3 * self._first_triangles()[1:])

    def turned(self, angle: NDArray[np.float64]) -> Outlines:
        """Each chart turned by radians (k,) about the origin of its plane."""
        first = self._first_triangles()
        z = np.zeros_like(self.z)
        z[self.corners] = (self.z[self.corners] + self.low[self.owner]) * np.exp(1j * angle)[self.owner]
        sides = z[self.corners]
        low = np.minimum.reduceat(sides.real.min(axis=0), first) + 1j * np.minimum.reduceat(
            sides.imag.min(axis=0), first
        )
        high = np.maximum.reduceat(sides.real.max(axis=0), first) + 1j * np.maximum.reduceat(
            sides.imag.max(axis=0), first
        )
        z[self.corners] = sides - low[self.owner]
        return replace(self, z=z, low=low, size=high - low)

    def boxes(self) -> Outlines:
        """The boxes around the charts."""
        return replace(self.chosen(np.zeros(len(self), dtype=bool)).with_boxes(self.size), low=self.low)

    def _first_triangles(self) -> NDArray[np.int64]:
        return np.searchsorted(self.owner, np.arange(len(self)))

    def chosen(self, wanted: NDArray[np.bool_]) -> Outlines:
        """Some of the charts."""
        taken = wanted[self.owner]
        number = np.cumsum(wanted) - 1
        used, corners = np.unique(self.corners[:, taken], return_inverse=True)
        return Outlines(
            self.z[used], corners.reshape(3, -1), number[self.owner[taken]], self.low[wanted], self.size[wanted]
        )

    def with_boxes(self, size: NDArray[np.complex128]) -> Outlines:
        """These charts, and after them rectangles of the given sizes."""
        count = np.arange(len(size))
        z = np.stack((0.0 * size, size.real, size, 1j * size.imag), axis=1)
        corners = (np.array([[0, 0], [1, 2], [2, 3]])[:, None, :] + 4 * count[:, None]).reshape(3, -1) + len(self.z)
        return Outlines(
            np.concatenate((self.z, z.reshape(-1))),
            np.concatenate((self.corners, corners), axis=1),
            np.concatenate((self.owner, len(self) + np.repeat(count, 2))),
            np.concatenate((self.low, 0.0 * size)),
            np.concatenate((self.size, size)),
        )


def chart_outlines(charts: Sequence[tuple[NDArray[np.complex128], NDArray[np.integer]]]) -> Outlines:
    """Of charts by positions (n,), at least one, and triangles (3, m), m >= 0."""
    points = [np.asarray(z, dtype=np.complex128) for z, _ in charts]
    faces = [
        np.asarray(corners, dtype=np.int64) if np.size(corners) else np.tile(np.arange(len(z)), (3, 1))
        for z, (_, corners) in zip(points, charts, strict=True)
    ]
    count = np.array([len(z) for z in points])
    triangles = np.array([corners.shape[1] for corners in faces])
    first = np.cumsum(count) - count
    corners = np.concatenate(faces, axis=1) + np.repeat(first, triangles)
    return _in_corners(np.concatenate(points), first, count, corners, np.repeat(np.arange(len(points)), triangles))


def joint_outlines(z: NDArray[np.complex128], corners: NDArray[np.integer], owner: NDArray[np.int64]) -> Outlines:
    """Of charts by positions that all share.

    Parameters
    ----------
    corners : (3, m) integers
        Triangles; a position is of one chart only.
    owner : (m,) int64
        The chart of each, 0 .. k - 1, each of which has one.
    """
    chart = np.full(len(z), -1)
    chart[corners] = owner
    used = np.flatnonzero(chart >= 0)
    used = used[np.argsort(chart[used], kind="stable")]
    number = np.empty(len(z), dtype=np.int64)
    number[used] = np.arange(len(used))
    count = np.bincount(chart[used])
    turn = np.argsort(owner, kind="stable")
    return _in_corners(z[used], np.cumsum(count) - count, count, number[corners[:, turn]], owner[turn])


def disk_outlines(radius: NDArray[np.float64]) -> Outlines:
    """Of disks around 0, as polygons around them."""
    sides = DISK_SIDES if len(radius) < MANY_DISKS else 4
    round_about = np.exp(2j * np.pi * (np.arange(sides) + 0.5) / sides) / np.cos(np.pi / sides)
    fan = np.stack((np.zeros(sides - 2, dtype=np.int64), np.arange(1, sides - 1), np.arange(2, sides)))
    first = sides * np.arange(len(radius))
    corners = (fan[:, None, :] + first[:, None]).reshape(3, -1)
    z = (radius[:, None] * round_about).reshape(-1)
    return _in_corners(z, first, np.full(len(radius), sides), corners, np.repeat(np.arange(len(radius)), sides - 2))


def unit_disk() -> tuple[NDArray[np.complex128], NDArray[np.int64]]:
    """Positions and triangles of a polygon around the unit disk."""
    outlines = disk_outlines(np.ones(1))
    return outlines.z + outlines.low[0], outlines.corners


def _in_corners(
    z: NDArray[np.complex128],
    first: NDArray[np.int64],
    count: NDArray[np.int64],
    corners: NDArray[np.int64],
    owner: NDArray[np.int64],
) -> Outlines:
    low = np.minimum.reduceat(z.real, first) + 1j * np.minimum.reduceat(z.imag, first)
    high = np.maximum.reduceat(z.real, first) + 1j * np.maximum.reduceat(z.imag, first)
    return Outlines(z - np.repeat(low, count), corners, owner, low, high - low)
