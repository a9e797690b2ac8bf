"""Polygons of thousands of corners: true triangulations over all their corners."""

from __future__ import annotations

import numpy as np
import pytest

from conformal_uv.mesh.large_polygons import cut_large_polygon
from conformal_uv.mesh.polygons import PolygonMesh
from conformal_uv.mesh.triangulate import triangulate


def circle(n: int) -> np.ndarray:
    turn = 2 * np.pi * np.arange(n) / n
    return np.column_stack((np.cos(turn), np.sin(turn)))


def wavy(n: int) -> np.ndarray:
    turn = 2 * np.pi * np.arange(n) / n
    return (1 + 0.2 * np.sin(7 * turn))[:, None] * circle(n)


def noisy(n: int) -> np.ndarray:
    return np.random.default_rng(0).uniform(0.99, 1.0, n)[:, None] * circle(n)


def star(n: int) -> np.ndarray:
    return np.where(np.arange(n) % 2, 1.0, 0.5)[:, None] * circle(n)


def square(n: int) -> np.ndarray:
    """Nearly all corners on straight sides."""
    step = np.arange(n // 4)[:, None] / (n // 4)
    ends = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    return np.concatenate([a + step * (b - a) for a, b in zip(ends, np.roll(ends, -1, axis=0), strict=True)])


def spiral(n: int) -> np.ndarray:
    turn = np.linspace(0, 12 * np.pi, n // 2)
    arm = np.column_stack((np.cos(turn), np.sin(turn)))
    return np.concatenate(((4 + turn)[:, None] * arm, ((1 + turn)[:, None] * arm)[::-1]))


@pytest.mark.parametrize("shape", [circle, wavy, noisy, star, square, spiral])
@pytest.mark.parametrize("n", [256, 300, 4000])
def test_triangles_cover_the_polygon(shape: object, n: int) -> None:
    P = shape(n)  # type: ignore[operator]
    F = cut_large_polygon(P)
    assert F is not None and F.shape == (n - 2, 3)
    a, b, c = (P[corner] for corner in F.T)
    area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    after = np.roll(P, -1, axis=0)
    whole = 0.5 * (P[:, 0] * after[:, 1] - P[:, 1] * after[:, 0]).sum()
    assert (area > -1e-15).all()
    assert area.sum() == pytest.approx(whole, rel=1e-12)


def test_a_polygon_in_space_keeps_its_winding_and_its_sides() -> None:
    n = 5000
    P = noisy(n)
    V = np.column_stack((P[:, 0], 0.3 * P[:, 0] + P[:, 1], P[:, 1]))
    F, face, corner = triangulate(PolygonMesh(V, np.arange(n), np.array([0, n])))
    assert len(F) == n - 2
    ahead = F[:, [1, 2, 0]]
    sides = (F + 1) % n == ahead
    assert np.array_equal(np.sort(F[sides]), np.arange(n))


def test_a_polygon_that_crosses_itself_still_has_all_its_corners() -> None:
    n = 300
    turn = 4 * np.pi * np.arange(n) / n
    V = np.column_stack((np.cos(turn), np.sin(2 * turn), 0 * turn))
    F, _, _ = triangulate(PolygonMesh(V, np.arange(n), np.array([0, n])))
    assert len(F) == n - 2 and len(np.unique(F)) == n
