"""Branches of the charts that ordinary meshes seldom take, each against what it is to do."""

from __future__ import annotations

import numpy as np

import conformal_uv as cuv
from conformal_uv.charts.chart_progress import ChartProgress
from conformal_uv.charts.cut_graph import OneChart, _cotree


def pair_of_polygons(length: list[float]) -> OneChart:
    """Two polygons joined across several sides."""
    k = len(length)
    one = np.arange(k)
    none = np.empty(0, dtype=np.int64)
    return OneChart(one, (one + 1) % k, 0 * one, 0 * one + 1, np.array(length), none, none, k, 2)


def test_of_several_sides_between_two_polygons_the_tree_crosses_the_heaviest() -> None:
    """A spanning tree of largest weight has the heaviest of parallel edges, wherever it stands in the list."""
    for heaviest in range(4):
        weight = np.array([1.0, 2.0, 3.0, 4.0])[np.roll(np.arange(4), heaviest)]
        crossed = _cotree(pair_of_polygons([1.0] * 4), np.arange(4), weight)
        assert np.flatnonzero(crossed).tolist() == [int(np.argmax(weight))]


def test_a_polygon_whose_diagonal_is_the_side_of_another_is_mapped() -> None:
    """A quad and a triangle that share two sides: cut along its shorter diagonal, the quad would lay a third triangle
    on the triangle's third side."""
    V = np.array([[0, 0, 0], [1, 0, 0], [0.5, 2, 0], [0.5, -2, 0], [0.5, 1, 1.0]])
    a, c, b, d, e = range(5)
    u = cuv.unwrap(V, [[a, b, c, d], [a, d, c], [c, b, e], [b, a, e]], place="disk")
    (chart,) = u.charts
    quad = chart.F[chart.polygon == 0]
    assert {a, c} <= set(chart.vertices[quad[0]]) and {a, c} <= set(chart.vertices[quad[1]])  # it is cut there
    assert u.summary == "mapped 1 of 1 chart" and not len(chart.map.flipped)


def test_fractions_of_a_stage_that_goes_back_do_not() -> None:
    """A map may do a stage again (another factorization): what the callback is told never falls."""
    told: list[float] = []
    progress = ChartProgress(lambda stage, fraction: told.append(fraction))
    progress.weigh(np.array([1, 3]))
    for chart in (0, 1):
        progress.start(chart)
        for stage, fraction in (("linear", 1.0), ("newton", 0.5), ("factorization", 0.0), ("unheard of", 1.0)):
            progress(stage, fraction)
    assert told == sorted(told) and len(set(told)) == 4
