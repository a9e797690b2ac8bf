"""Any mesh at all: a finite map with its boundary on the circle and nothing folded, or a ConformalUVError.

CONFORMAL_UV_FUZZ=10000 python -m pytest tests/test_fuzz.py runs ten thousand meshes instead of two thousand.
"""

from __future__ import annotations

import os

import numpy as np
import pytest
from fuzz_meshes import random_mesh
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import conformal_uv as cuv

COUNT = int(os.environ.get("CONFORMAL_UV_FUZZ", "2000"))
BATCH = 100

pytestmark = pytest.mark.filterwarnings("error")


def assert_sound(m: cuv.DiskMap, *, repaired: bool) -> None:
    """What every returned map satisfies."""
    assert np.isfinite(m.uv).all()
    radius = np.hypot(m.uv[:, 0], m.uv[:, 1])
    assert radius.max() <= 1 + 1e-15  # hypot of a rounded point of the circle
    assert np.abs(radius[m.boundary] - 1).max() <= 1e-12
    assert np.isfinite([m.conformal_energy, m.dirichlet_energy]).all()
    d = m.distortion
    assert np.isfinite(d.angle_error).all()
    assert not np.isnan(d.quasi_conformal).any() and not np.isnan(d.area_scale).any()
    assert set(m.lost_to_double) <= set(m.flipped)
    if repaired and m.repair is not None:
        assert m.repair.flipped_after == len(m.flipped) <= m.repair.flipped_before


@pytest.mark.parametrize("batch", range(0, COUNT, BATCH))
def test_random_mesh_is_mapped_or_refused(batch: int) -> None:
    mapped = 0
    for seed in range(batch, min(batch + BATCH, COUNT)):
        V, F = random_mesh(seed)
        rng = np.random.default_rng([seed, 1])
        options = {
            "method": rng.choice(["linear", "newton"]),
            "repair": rng.choice(["auto", "auto", "never"]),
            "backend": rng.choice(["auto", "superlu"]),
        }
        try:
            m = cuv.disk_map(V, F, **options)
        except cuv.ConformalUVError as error:
            assert str(error)
            continue
        except Exception as error:
            raise AssertionError(f"mesh {seed} with {options}: {error!r}") from error
        try:
            assert_sound(m, repaired=options["repair"] == "auto")
        except AssertionError as error:
            raise AssertionError(f"mesh {seed} with {options}: {error}") from error
        mapped += 1
    assert mapped > BATCH // 10  # the generator makes disks, not only refusals


@pytest.mark.parametrize("batch", range(0, COUNT // 4, BATCH))
def test_random_mesh_is_unwrapped_chart_by_chart(batch: int) -> None:
    """With every mending switched on at random, no mesh of finite arrays raises; charts fail one by one."""
    for seed in range(batch, batch + BATCH):
        V, F = random_mesh(seed)
        rng = np.random.default_rng([seed, 2])
        options = {
            "method": rng.choice(["linear", "newton"]),
            "holes": rng.choice(["fill", "refuse"]),
            "closed": rng.choice(["cut", "refuse"]),
            "nonmanifold": rng.choice(["cut", "refuse"]),
            "orientation": rng.choice(["mend", "refuse"]),
            "place": "disk",
        }
        try:
            u = cuv.unwrap(V, F, **options)
        except cuv.ConformalUVError:
            continue
        except Exception as error:
            raise AssertionError(f"mesh {seed} with {options}: {error!r}") from error
        assert np.isfinite(u.uv).all() and np.abs(u.uv).max(initial=0.0) <= 1.0 + 1e-15, seed
        assert (u.chart_of_face >= 0).all(), seed
        for chart in u.charts:
            assert (chart.map is None) != (chart.error is None), seed
            if chart.map is not None:
                assert set(chart.map.lost_to_double) <= set(chart.map.flipped), seed


numbers = st.floats(allow_nan=True, allow_infinity=True, width=64)


# Five faces without area and one sliver, whose map has no area in doubles.
ONE_SLIVER = np.zeros((7, 3))
ONE_SLIVER[[0, 2, 5], [0, 0, 1]] = 6.990457903298616e49, 2.044322719514035e63, 2.0443227195140352e63


@settings(max_examples=300, deadline=None, derandomize=True)
@given(arrays(np.float64, (7, 3), elements=numbers))
@example(ONE_SLIVER)
def test_any_positions_of_a_wheel(V: np.ndarray) -> None:
    """Six triangles around a vertex, with any doubles for positions."""
    F = [[6, k, (k + 1) % 6] for k in range(6)]
    try:
        m = cuv.disk_map(V, F)
    except cuv.ConformalUVError:
        return
    assert_sound(m, repaired=True)


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.lists(st.tuples(*[st.integers(-1, 8)] * 3), max_size=12), st.integers(0, 9))
def test_any_faces_over_random_points(F: list[tuple[int, int, int]], n: int) -> None:
    V = np.random.default_rng(n).random((n, 3))
    try:
        m = cuv.disk_map(V, F)
    except cuv.ConformalUVError:
        return
    assert_sound(m, repaired=True)
