"""Which polygon corner each triangle corner is."""

from __future__ import annotations

import numpy as np
import pytest

from meshlab_filter.wedges import triangle_wedges, wedges_of_polygons


def listed(*polygons: list[int]) -> list[np.ndarray]:
    return [np.array(polygon, dtype=np.uint32) for polygon in polygons]


# A hexagon whose middle triangle (0, 2, 4) has no side of the hexagon, a triangle beside it, a quad beside that.
HEXAGON = [[0, 1, 2], [2, 3, 4], [0, 2, 4], [4, 5, 0]]
F = np.array([*HEXAGON[:2], [1, 6, 2], *HEXAGON[2:], [6, 7, 8], [6, 8, 2]])
POLYGONS = listed([2, 3, 4, 5, 0, 1], [8, 2, 6, 7], [6, 2, 1])


def test_every_triangle_finds_its_polygon_and_every_corner_its_own():
    wedges = wedges_of_polygons(F, POLYGONS, 9)
    np.testing.assert_array_equal(wedges.polygon, [0, 0, 2, 0, 0, 1, 1])
    np.testing.assert_array_equal(wedges.corners[wedges.corner], F.reshape(-1))
    owner = np.searchsorted(wedges.starts, wedges.corner, side="right") - 1
    np.testing.assert_array_equal(owner, np.repeat(wedges.polygon, 3))
    np.testing.assert_array_equal(np.diff(wedges.starts), [6, 4, 3])


@pytest.mark.parametrize(
    "faces, polygons",
    [
        (np.vstack((F, F[:1])), POLYGONS),  # a face that stands twice
        (F, [*POLYGONS, POLYGONS[2]]),  # a polygon that stands twice
        (F[:-1], POLYGONS),  # half a quad
        (F, POLYGONS[:-1]),  # a triangle of no polygon
        (F[:, ::-1], POLYGONS),  # wound the other way
    ],
)
def test_what_does_not_fit_is_left_as_triangles(faces: np.ndarray, polygons: list[np.ndarray]):
    assert wedges_of_polygons(faces, polygons, 9) is None


def test_triangles_are_their_own_polygons():
    wedges = triangle_wedges(F)
    np.testing.assert_array_equal(wedges.corners[wedges.corner].reshape(-1, 3), F)
    np.testing.assert_array_equal(wedges.starts, 3 * np.arange(len(F) + 1))


def test_a_polygon_without_triangles_is_none_of_this_mesh():
    F = np.array([[0, 1, 2], [0, 2, 3]])
    square, other = np.array([0, 1, 2, 3], dtype=np.uint32), np.array([4, 5, 6], dtype=np.uint32)
    assert wedges_of_polygons(F, [square], 7) is not None
    assert wedges_of_polygons(F, [square, other], 7) is None
