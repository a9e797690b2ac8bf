"""Distortion of polygons and its colours: closed forms, the maps' own numbers, published tables."""

from __future__ import annotations

import numpy as np
import pytest

import conformal_uv as cuv
from conformal_uv.samples import mask


def test_a_stretch_has_the_angles_of_a_stretch():
    """A unit square to 2 x 1: corners of its halves go from 45 to atan 2 and atan 1/2 degrees, right ones stay."""
    V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    mesh = cuv.PolygonMesh(V, np.arange(4), np.array([0, 4]))
    found = cuv.polygon_distortion(mesh, V[:, :2] * [2, 1])
    expected = 2.0 * np.degrees(np.arctan(2.0) - np.pi / 4) / 3.0
    assert found.angle_error == pytest.approx([expected]) and found.area_scale == pytest.approx([1.0])


def test_the_numbers_are_those_of_the_map():
    V, F = mask(800)
    u = cuv.unwrap(V, F)
    mesh = cuv.PolygonMesh(V, F.reshape(-1), np.arange(0, F.size + 1, 3))
    found = cuv.polygon_distortion(mesh, u.uv)
    numbers = cuv.unwrap_numbers(u).distortion
    assert found.angle_error.mean() == pytest.approx(numbers.angle_mean, rel=1e-9)
    assert found.area_scale.max() / found.area_scale.min() == pytest.approx(numbers.area_ratio, rel=1e-6)
    area = cuv.face_areas(V, F)
    assert (found.area_scale * area).sum() / area.sum() == pytest.approx(1.0)


def test_faces_without_area_and_coordinates_that_are_none():
    V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 2, 0], [np.nan, 0, 0]])
    mesh = cuv.PolygonMesh(V, np.array([0, 1, 2, 0, 2, 3, 0, 1, 4]), np.array([0, 3, 6, 9]))
    uv = np.array([[0, 0], [1, 0], [0, 1], [0, 0], [1, 0], [1, 1], [0, np.inf], [0, 1], [1, 1]])
    found = cuv.polygon_distortion(mesh, uv)
    assert np.isfinite(found.angle_error).all() and found.area_scale[1] == np.inf and found.area_scale[0] > 0
    nothing = cuv.polygon_distortion(mesh, np.zeros((9, 2)))
    assert nothing.area_scale.tolist() == [0.0, 0.0, 0.0]
    assert np.isfinite(cuv.area_colors(found.area_scale)).all()


@pytest.mark.parametrize(("name", "colors"), [("viridis", cuv.angle_colors), ("coolwarm", cuv.area_colors)])
def test_colours_are_those_of_the_published_scales(name, colors):
    colormaps = pytest.importorskip("matplotlib").colormaps
    part = np.linspace(0.0, 1.0, 65)
    values = 10.0 * part if name == "viridis" else 2.0 ** (2.0 * part - 1.0)
    off = np.abs(colors(values) - colormaps[name](part)[:, :3])
    assert off.max() < 0.07 and off.mean() < 0.01  # nine colours and straight lines between them
    far = colors([-1.0 if name == "viridis" else 0.0, 1e9, np.inf])
    np.testing.assert_allclose(far, colormaps[name]([0.0, 1.0, 1.0])[:, :3], atol=0.01)


def test_limits_of_colours_are_checked():
    with pytest.raises(cuv.OptionError, match="most is 0"):
        cuv.angle_colors([1.0], 0.0)
    with pytest.raises(cuv.OptionError, match="most is 1"):
        cuv.area_colors([1.0], 1.0)


def test_a_flat_mesh_has_a_vertex_for_each_place():
    V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]], dtype=float)
    mesh = cuv.PolygonMesh(V, np.array([0, 1, 2, 3, 1, 4, 5, 2]), np.array([0, 4, 8]))
    joined = cuv.flattened(mesh, 0.1 * V[mesh.corners][:, :2], true_size=False)
    assert len(joined.mesh.V) == 6 and not len(joined.torn)
    np.testing.assert_allclose(joined.mesh.V, 0.1 * V[joined.vertex])
    torn = 0.1 * V[mesh.corners][:, :2] + np.repeat([[0.0, 0.0], [5.0, 0.0]], 4, axis=0)
    flat = cuv.flattened(mesh, torn, margin=0.25)
    assert flat.torn.tolist() == [1, 2] and len(flat.mesh.V) == 8
    np.testing.assert_array_equal(flat.vertex[flat.mesh.corners], mesh.corners)
    quads = flat.mesh.V[flat.mesh.corners].reshape(2, 4, 3)
    np.testing.assert_allclose(np.ptp(quads, axis=1), [[1, 1, 0], [1, 1, 0]], atol=1e-12)
    low, high = quads.min(axis=1), quads.max(axis=1)
    assert max((low[0] - high[1]).max(), (low[1] - high[0]).max()) >= 0.25 - 1e-9
