"""Spikes up to 1e12 times as high as wide: thin triangles, and none without area."""

from __future__ import annotations

import numpy as np
import pytest
from nasty_meshes import grid

import conformal_uv as cuv


def spiked(seed: int, height: float, n: int, size: float) -> tuple[np.ndarray, np.ndarray]:
    V, F = grid(n, n, size, size)
    rng = np.random.default_rng(seed)
    some = rng.choice(n * n, rng.integers(1, 20), replace=False)
    V = np.column_stack((V[:, :2], np.zeros(n * n)))
    V[some, 2] = height * (rng.random(len(some)) if seed % 3 else 1.0)
    return V, F


@pytest.mark.parametrize("height", [1e6, 1e9, 1e12])
@pytest.mark.parametrize("seed", range(20))
def test_needles_map_by_default(seed: int, height: float) -> None:
    V, F = spiked(seed, height, 10 + seed % 2, 9.0 if seed % 2 else 1.0)
    result = cuv.disk_map(V, F)
    assert np.isfinite(result.uv).all()
    assert np.abs(np.linalg.norm(result.uv[result.boundary], axis=1) - 1.0).max() < 1e-12
    around = result.uv[result.boundary]
    turns = np.angle((around @ (1, 1j)) / (np.roll(around, 1, axis=0) @ (1, 1j)))
    turns[turns < -1e-12] += 2.0 * np.pi  # one arc may be longer than pi
    assert abs(turns.sum() - 2.0 * np.pi) < 1e-9


@pytest.mark.parametrize("height", [1e3, 1e6, 1e9])
def test_one_needle_moves_nothing_else(height: float) -> None:
    """Of a spike's tip nothing is seen from below: the vertices around stay where lower spikes leave them."""
    V, F = grid(10, 10, 9.0, 9.0)
    V = np.column_stack((V[:, :2], np.zeros(100)))
    tip = 44
    V[tip, 2] = 1e3
    low = cuv.disk_map(V, F, method="linear").uv
    V[tip, 2] = height
    high = cuv.disk_map(V, F, method="linear").uv
    others = np.arange(100) != tip
    # the Dirichlet-to-Neumann map of a cone of height h differs from the infinite one's by O(1 / h)
    assert np.abs(high - low)[others].max() < 1e-2
