"""Loose triangles joined where corners have exactly the same position."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

__all__ = ["welded"]

Number = TypeVar("Number", np.float32, np.float64)
Ints = NDArray[np.int64]

FACTORS = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], np.uint64)
TRIES = 8
BLOCK = 1 << 16  # rows looked at together


def welded(soup: NDArray[Number]) -> tuple[NDArray[Number], Ints]:
    """Positions in order of appearance, and the index of each corner among them. NaN equals nothing."""
    example = np.arange(len(soup), dtype=np.int32 if len(soup) < 2**31 else np.int64)
    open_rows = np.flatnonzero((soup[:, 0] == soup[:, 0]) & (soup[:, 1] == soup[:, 1]) & (soup[:, 2] == soup[:, 2]))
    open_rows = open_rows.astype(example.dtype)
    for turn in range(TRIES):
        if len(open_rows):
            open_rows = _matched(soup, example, open_rows, turn)
    if len(open_rows):
        example[open_rows] = _sorted(soup[open_rows], open_rows)
    new = example == np.arange(len(soup), dtype=example.dtype)
    number: NDArray[Any] = np.cumsum(new, dtype=example.dtype)
    number -= np.ones((), example.dtype)
    return soup[new], number[example].astype(np.int64)


def _matched(soup: NDArray[Number], example: NDArray[Any], rows: NDArray[Any], turn: int) -> NDArray[Any]:
    """Give rows the first of their equals as example, by a table in which the first row of each hash stands; the rows
    whose place another position has are left for the next turn."""
    bits = max(int(len(rows)).bit_length(), 4)
    place = np.empty(len(rows), rows.dtype)
    for begin in range(0, len(rows), BLOCK):
        some = slice(begin, begin + BLOCK)
        place[some] = _hashes(soup[rows[some]], turn) >> np.uint64(64 - bits)
    table = np.empty(1 << bits, rows.dtype)
    table[place[::-1]] = rows[::-1]
    left = []
    for begin in range(0, len(rows), BLOCK):
        here = rows[begin : begin + BLOCK]
        first = table[place[begin : begin + BLOCK]]
        differ = soup.take(here, axis=0) != soup.take(first, axis=0)
        other = differ[:, 0] | differ[:, 1] | differ[:, 2]
        example[here] = np.where(other, here, first)
        left.append(here[other])
    return np.concatenate(left)


def _hashes(points: NDArray[Number], turn: int) -> NDArray[np.uint64]:
    parts: NDArray[Any] = (points + 0.0).view(np.uint32 if points.dtype == np.float32 else np.uint64)  # -0.0 is 0.0
    key = np.zeros(len(points), np.uint64)
    for k in range(3):
        key += parts[:, k]
        key *= FACTORS[(k + turn) % 3]
        key ^= key >> np.uint64(29 + turn)
    return key


def _sorted(points: NDArray[Number], rows: NDArray[Any]) -> NDArray[Any]:
    """The first row of each row's equals, by sorting."""
    order = np.lexsort((points[:, 2], points[:, 1], points[:, 0]))
    sorted_points = points[order]
    new = np.ones(len(rows), dtype=bool)
    new[1:] = (sorted_points[1:] != sorted_points[:-1]).any(axis=1)
    found = np.empty_like(rows)
    found[order] = rows[order[new]][np.cumsum(new) - 1]  # the sort is stable
    return found
