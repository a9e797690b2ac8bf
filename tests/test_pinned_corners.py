"""Charts held by corners whose texture coordinates are given."""

from __future__ import annotations

import numpy as np
import pytest

import conformal_uv as cuv
from conformal_uv.samples import mask


@pytest.fixture(scope="module")
def pair():
    """A mask, and the same elsewhere: two charts."""
    V, F = mask(300)
    return np.concatenate((V, V + [5.0, 0.0, 0.0])), np.concatenate((F, F + len(V))), len(V), len(F)


def test_the_chart_is_the_pinned_map_and_others_are_as_without(pair):
    V, F, n, m = pair
    pins = {3 * 7: (0.9, 0.2), 3 * 150 + 1: (1.7, -0.4), 3 * 250 + 2: (0.1, 0.6)}
    got = cuv.unwrap(V, F, shape="free", pinned_uv=pins)
    assert got.charts.held.tolist() == [True, False]
    of_vertex = {int(F.reshape(-1)[corner]): place for corner, place in pins.items()}
    expected = cuv.pinned_map(V[:n], F[:m], of_vertex).uv[F[:m].reshape(-1)]
    np.testing.assert_allclose(got.uv[: 3 * m], expected, rtol=0, atol=1e-9)
    for corner, place in pins.items():
        assert got.uv[corner].tolist() == list(place)  # to the bit
    alone = cuv.unwrap(V, F, selection=np.arange(m, 2 * m), shape="free")
    np.testing.assert_allclose(got.uv[3 * m :], alone.uv[3 * m :], rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("shape", "pins"),
    [
        ("free", {0: (0.5, 0.5)}),
        ("free", {0: (0.5, 0.5), 90: (0.5, 0.5)}),  # one point
        ("disk", {0: (0.1, 0.5), 90: (0.5, 0.5)}),
        ("free", {}),
        ("free", None),
    ],
)
def test_too_few_pins_and_other_shapes_change_nothing(pair, shape, pins):
    V, F, _, _ = pair
    got = cuv.unwrap(V, F, shape=shape, pinned_uv=pins)
    assert not got.charts.held.any()
    np.testing.assert_array_equal(got.uv, cuv.unwrap(V, F, shape=shape).uv)


def test_corners_of_one_vertex_are_one_pin_and_seams_have_two_sides():
    V = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0]]
    squares = [[0, 1, 4, 3], [1, 2, 5, 4]]
    whole = cuv.unwrap(V, squares, shape="free", pinned_uv={1: (0.3, 0.3), 4: (0.3, 0.3)})
    assert not whole.charts.held.any()  # both are vertex 1
    pins = {1: (0.0, 0.0), 2: (0.0, 2.0), 4: (3.0, 3.0), 7: (3.0, 3.5)}
    cut = cuv.unwrap(V, squares, seams=[[1, 4]], shape="free", pinned_uv=pins)
    assert cut.charts.held.all()
    np.testing.assert_allclose(cut.uv[:4], [[-2, 0], [0, 0], [0, 2], [-2, 2]], rtol=0, atol=1e-12)
    np.testing.assert_allclose(cut.uv[4:], [[3, 3], [3.5, 3], [3.5, 3.5], [3, 3.5]], rtol=0, atol=1e-12)


def test_packing_together_leaves_them_and_numbers_count_them(pair):
    V, F, _, m = pair
    unwrapper = cuv.Unwrapper(V, F)
    pins = {0: (0.2, 0.2), 3 * 100: (0.3, 0.3)}
    got = unwrapper.unwrap(shape="free", place="disk", pinned_uv=pins)
    (packed,) = cuv.pack_together([got], [np.ones(2, dtype=bool)])
    np.testing.assert_array_equal(packed[: 3 * m], got.uv[: 3 * m])
    assert packed[3 * m :].min() >= 0.0 and packed[3 * m :].max() <= 1.0
    numbers = cuv.unwrap_numbers(got, uv=packed)
    assert numbers.mapped_charts == 2 and numbers.distortion.angle_mean < 10.0
    other = unwrapper.unwrap(shape="free", place="disk", pinned_uv={0: (0.2, 0.2), 3 * 100: (0.4, 0.4)})
    np.testing.assert_allclose(other.uv[: 3 * m] - 0.2, 2.0 * (got.uv[: 3 * m] - 0.2), rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    "pins",
    [{-1: (0, 0)}, {10**6: (0, 0)}, {0: (np.nan, 0), 1: (0, 0)}, {0: (0, 0, 0)}, {0.5: (0, 0)}, {0: "a"}, [1, 2]],
)
def test_what_is_no_place_of_a_corner_is_refused(pair, pins):
    V, F, _, _ = pair
    with pytest.raises(cuv.OptionError, match="pinned_uv"):
        cuv.unwrap(V, F, shape="free", pinned_uv=pins)
