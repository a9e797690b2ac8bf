"""Islands of given coordinates: found as Blender finds them, packed together, nothing else moved."""

from __future__ import annotations

import numpy as np
import pytest
from polygon_shapes import grid, side_by_side

import conformal_uv as cuv
from conformal_uv.charts.outlines import chart_outlines, joint_outlines


def squares(count, size=1.0):
    """Quads that hang together in space, each an island of its own at the same place in the texture."""
    V, Q = grid(count, 1)
    mesh = cuv.PolygonMesh(V.astype(float), Q.reshape(-1).astype(np.int64), np.arange(0, 4 * count + 1, 4))
    uv = np.tile(size * np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float), (count, 1))
    return mesh, uv


def test_islands_hang_together_across_edges_not_at_points():
    mesh = cuv.PolygonMesh(np.zeros((5, 3)), np.array([0, 1, 2, 2, 3, 4]), np.array([0, 3, 6]))
    uv = np.array([[0, 0], [1, 0], [1, 1], [1, 1], [2, 1], [2, 2]], dtype=float)
    assert cuv.uv_islands(mesh, uv).island.tolist() == [0, 1]
    V, Q = side_by_side(3)
    mesh = cuv.PolygonMesh(V, Q.reshape(-1), np.arange(0, Q.size + 1, 4))
    one = np.unique(cuv.uv_islands(mesh, V[mesh.corners][:, :2]).island, return_counts=True)[1]
    assert one.tolist() == [len(Q) // 3] * 3
    chosen = np.arange(len(Q)) < len(Q) // 3
    assert cuv.uv_islands(mesh, V[mesh.corners][:, :2], chosen).island.max() == 0
    assert (cuv.uv_islands(mesh, V[mesh.corners][:, :2], chosen).island[~chosen] == -1).all()


def test_minus_zero_is_zero():
    mesh = cuv.PolygonMesh(np.zeros((4, 3)), np.array([0, 1, 2, 0, 2, 3]), np.array([0, 3, 6]))
    uv = np.array([[0, 0], [1, 0], [1, 1], [-0.0, 0], [1, 1], [0, 1]])
    assert cuv.uv_islands(mesh, uv).island.tolist() == [0, 0]


def boxes(*uvs):
    quads = np.concatenate(uvs).reshape(-1, 4, 2)
    return quads.min(axis=1), quads.max(axis=1)


def test_islands_of_several_meshes_share_the_square():
    (a, uv_a), (b, uv_b) = squares(5), squares(4, 0.5)
    packed = cuv.pack_islands([a, b], [uv_a, uv_b], margin=0.01)
    low, high = boxes(*packed)
    assert low.min() >= 0.01 and high.max() <= 0.99
    apart = np.maximum(low[:, None] - high, low - high[:, None]).max(axis=2) + np.diag([np.inf] * 9)
    assert apart.min() >= 0.01
    side = (high - low)[:, 0]
    np.testing.assert_allclose(side[:5] / side[5], 2.0, rtol=1e-9)  # as they were to each other
    assert (side**2).sum() > 0.6
    averaged = cuv.pack_islands([a, b], [uv_a, uv_b], margin=0.01, average_scale=True)
    side = np.subtract(*boxes(*averaged)[::-1])[:, 0]
    np.testing.assert_allclose(side / side[0], 1.0, rtol=1e-9)  # as on the surface, where all are unit squares


def test_what_is_not_chosen_stays():
    mesh, uv = squares(4)
    chosen = np.array([True, False, True, False])
    (packed,) = cuv.pack_islands([mesh], [uv], [chosen], tile=1002, keep_scale=True, margin=0.0)
    corner = np.repeat(chosen, 4)
    np.testing.assert_array_equal(packed[~corner], uv[~corner])
    low, high = boxes(packed[corner])
    assert low[:, 0].min() == pytest.approx(1.0) and low[:, 1].min() == pytest.approx(0.0, abs=1e-9)
    np.testing.assert_allclose(high - low, 1.0, atol=1e-12)
    (same,) = cuv.pack_islands([mesh], [uv], [np.zeros(4, dtype=bool)])
    np.testing.assert_array_equal(same, uv)


def test_concave_faces_and_what_is_not_finite():
    """An L of one face, another in its bay; a face without a place is put somewhere."""
    ell = np.array([[0, 0], [4, 0], [4, 1], [1, 1], [1, 4], [0, 4]], dtype=float)
    uv = np.concatenate([ell, ell[::-1] * -1.0, [[np.nan, 0], [np.inf, 0], [0, 1]]])
    mesh = cuv.PolygonMesh(np.zeros((15, 3)), np.arange(15), np.array([0, 6, 12, 15]))
    (packed,) = cuv.pack_islands([mesh], [uv[:15]], margin=0.001)
    assert np.isfinite(packed).all() and packed.min() >= 0.0 and packed.max() <= 1.0
    scale = np.ptp(packed[:6], axis=0) / 4.0
    np.testing.assert_allclose(scale, scale[0])
    assert 14.0 * scale[0] ** 2 > 0.5  # by their boxes at most 14 / 64


def test_options_are_checked():
    mesh, uv = squares(2)
    for wrong in ({"tile": 1000}, {"tile": True}, {"margin": -1.0}, {"pack_rotation": "sideways"}, {"image_size": 0}):
        with pytest.raises(cuv.OptionError):
            cuv.pack_islands([mesh], [uv], **wrong)
    for wrong in ({"margin_method": "add", "margin": -0.1}, {"margin_method": "pixels", "margin": 512}):
        with pytest.raises(cuv.OptionError, match="margin"):
            cuv.pack_islands([mesh], [uv], **wrong)


def test_outlines_of_charts_that_share_arrays_are_those_of_each():
    """Triangles in any order; positions of no triangle do not count."""
    rng = np.random.default_rng(6)
    z = rng.normal(size=40) + 1j * rng.normal(size=40)
    corners, owner = np.arange(36).reshape(12, 3), np.repeat([0, 1, 2], [3, 4, 5])
    turn = rng.permutation(12)
    joint = joint_outlines(z, corners[turn].T, owner[turn])
    each = chart_outlines([(z[:9], corners[:3].T), (z[9:21], corners[3:7].T - 9), (z[21:36], corners[7:].T - 21)])
    np.testing.assert_allclose(joint.low, each.low)
    np.testing.assert_allclose(joint.size, each.size)
    assert (np.diff(joint.owner) >= 0).all()
    for number in range(3):
        ours, theirs = (
            np.sort_complex(one.z[one.corners[:, one.owner == number]].reshape(-1)) for one in (joint, each)
        )
        np.testing.assert_allclose(ours, theirs)
