"""Packing: no two disks touch, all lie in the square, areas are true."""

from __future__ import annotations

import numpy as np
import pytest
from meshes import annulus
from polygon_shapes import side_by_side

from conformal_uv.charts import unwrap
from conformal_uv.charts.packing import kept_margin, pack_disks

RADII = {
    "equal": lambda rng, n: np.ones(n),
    "even": lambda rng, n: rng.uniform(0.1, 1.0, n),
    "heavy tail": lambda rng, n: rng.pareto(1.5, n) + 0.01,
    "one giant": lambda rng, n: np.append(np.full(n - 1, 1e-6), 1.0),
    "a point": lambda rng, n: (np.arange(n) < max(1, n - 1)).astype(float),
}


@pytest.mark.parametrize("margin", [0.0, 0.005, 0.03])
@pytest.mark.parametrize("count", [1, 2, 7, 40, 400])
@pytest.mark.parametrize("kind", RADII)
def test_disks_lie_apart_in_the_square(kind, count, margin):
    given = RADII[kind](np.random.default_rng(count), count)
    kept = kept_margin(margin, count)
    center, scale = pack_disks(given, kept)
    radius = scale * given
    apart = np.linalg.norm(center[:, None] - center, axis=2) - radius[:, None] - radius
    apart[np.diag_indices(count)] = np.inf
    assert apart.min() >= kept - 1e-12
    assert (center - radius[:, None]).min() >= kept - 1e-12
    assert (center + radius[:, None]).max() <= 1.0 - kept + 1e-12


def test_packing_uses_the_square():
    rng = np.random.default_rng(1)
    for count in (9, 30, 300):
        given = rng.uniform(0.3, 1.0, count)
        _, scale = pack_disks(given, 0.001)
        assert np.pi * ((scale * given) ** 2).sum() > 0.5  # circles in squares without gaps fill 0.785


def test_areas_are_true_to_each_other_with_holes_too():
    V, Q = side_by_side(5)
    W, F = annulus(16)
    polygons = [*Q.tolist(), *(F + len(V)).tolist()]
    points = np.concatenate((V, W - [50, 0, 0]))
    u = unwrap(points, polygons, margin=0.01)
    assert u.mapped.all() and u.uv.min() >= 0.01 - 1e-12 and u.uv.max() <= 0.99 + 1e-12
    sizes = np.array([len(q) for q in polygons])
    starts = np.concatenate(([0], np.cumsum(sizes)))
    ratios = []
    for chart in u.charts:
        image = surface = 0.0
        for p in chart.faces:
            x, y = u.uv[starts[p] : starts[p + 1]].T
            image += 0.5 * (x @ np.roll(y, -1) - np.roll(x, -1) @ y)
            x, y, _ = points[polygons[p]].T
            surface += 0.5 * (x @ np.roll(y, -1) - np.roll(x, -1) @ y)
        ratios.append(image / surface)
    assert ratios == pytest.approx(np.full(6, ratios[0]), rel=1e-9)


def test_charts_without_area_do_no_harm():
    V = np.concatenate((np.eye(3), np.zeros((3, 3)), np.eye(3) + 5))
    u = unwrap(V, np.arange(9).reshape(3, 3))
    assert np.isfinite(u.uv).all() and u.uv.min() >= 0 and u.uv.max() <= 1
    assert unwrap(np.zeros((6, 3)), np.arange(6).reshape(2, 3)).uv.max() <= 1
