"""Orientation on the sphere, decided exactly."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from conformal_uv.operators.orientation_sign import outward_signs


def determinant_signs(x: np.ndarray, corners: np.ndarray) -> list[int]:
    """Of the three corners as rows, in rational arithmetic."""
    signs = []
    for k in range(corners.shape[1]):
        a, b, c = ([Fraction(value) for value in x[v].tolist()] for v in corners[:, k])
        cross = [b[i - 2] * c[i - 1] - b[i - 1] * c[i - 2] for i in range(3)]
        volume = sum(p * q for p, q in zip(a, cross, strict=True))
        signs.append((volume > 0) - (volume < 0))
    return signs


@pytest.mark.parametrize("size", [1.0, 1e-5, 1e-9, 1e-14, 1e-16])
def test_signs_are_those_of_the_numbers_themselves(size: float) -> None:
    """Random triangles on the sphere, down to a few units in the last place across."""
    rng = np.random.default_rng(0)
    middle = rng.normal(size=(300, 3))
    middle /= np.linalg.norm(middle, axis=1, keepdims=True)
    x = np.concatenate([middle, *(middle + size * rng.normal(size=(2, 300, 3)))])
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    corners = np.arange(900, dtype=np.int32).reshape(3, -1)
    expected = determinant_signs(x, corners)
    np.testing.assert_array_equal(outward_signs(x, corners), expected)
    np.testing.assert_array_equal(outward_signs(x, corners[[1, 0, 2]]), np.negative(expected))


def test_a_triangle_in_a_plane_with_the_origin_has_no_sign() -> None:
    x = np.array([[1.0, 0, 0], [0, 1.0, 0], [-1.0, 0, 0], [0, 0, 1.0]])
    corners = np.array([[0, 0], [1, 1], [2, 3]], dtype=np.int32)
    np.testing.assert_array_equal(outward_signs(x, corners), [0, 1])


def test_signs_of_large_triangles_that_all_but_hold_the_origin() -> None:
    """Corners on a great circle but for their rounding, where the rounded determinant has the wrong sign of many."""
    rng = np.random.default_rng(1)
    a, b = rng.normal(size=(2, 400, 3))
    a, b = (p / np.linalg.norm(p, axis=1, keepdims=True) for p in (a, b))
    c = rng.normal(size=(400, 1)) * a + rng.normal(size=(400, 1)) * b
    c /= np.linalg.norm(c, axis=1, keepdims=True)
    expected = determinant_signs(np.concatenate((a, b, c)), np.arange(1200).reshape(3, -1))
    rounded = np.sign(np.einsum("ij,ij->i", a, np.cross(b - a, c - a)))
    assert np.count_nonzero(rounded != expected) > 20
    corners = np.arange(1200, dtype=np.int32).reshape(3, -1)
    np.testing.assert_array_equal(outward_signs(np.concatenate((a, b, c)), corners), expected)
