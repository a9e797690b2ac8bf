"""Branches of the charts that ordinary meshes seldom take, each against what it is to do."""

from __future__ import annotations

import numpy as np
import pytest
from meshes import annulus, disjoint, moebius_band, plate
from polygon_shapes import block, grid, tube

import conformal_uv as cuv
from conformal_uv.charts.chart_progress import ChartProgress
from conformal_uv.charts.cut_graph import OneChart, _cotree
from conformal_uv.charts.packing import pack_disks
from conformal_uv.charts.shelves import blocks_of_shelves
from conformal_uv.charts.spacing import kept_margin


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


def test_many_disks_keep_a_quarter_of_their_share_at_most() -> None:
    """A margin that left no room for the disks is cut: of 16, four along each side, a quarter is a share."""
    assert kept_margin(0.4, 16) == 0.25 / 4.0 and kept_margin(0.01, 16) == 0.01
    assert kept_margin(0.4, 1) == 0.25
    radius = np.ones(16)
    margin = kept_margin(0.4, 16)
    centers, scale = pack_disks(radius, margin)
    apart = np.linalg.norm(centers[:, None] - centers, axis=2)[np.triu_indices(16, 1)]
    assert apart.min() >= 2.0 * scale + margin - 1e-12
    assert scale > 0.05  # three quarters of a share across, less what whole cells take


@pytest.mark.parametrize("turned", [False, True])
def test_of_loops_alike_the_first_becomes_the_circle(turned: bool) -> None:
    """The two rims of a tube; the one whose polygon comes first."""
    V, Q = tube(8, 4, 3.0)
    Q = Q[::-1] if turned else Q
    (chart,) = cuv.unwrap(V, Q, method="linear").charts
    rim = np.arange(8) + (len(V) - 8 if turned else 0)
    assert sorted(chart.vertices[chart.map.boundary].tolist()) == rim.tolist()


def test_of_two_quads_that_share_a_diagonal_neither_is_preferred() -> None:
    """Both become stars: which one the caller names first makes no difference."""
    V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 1, 0.8]])
    one, other = [0, 1, 2, 3], [2, 1, 0, 4]
    u = cuv.unwrap(V, [one, other], place="disk", boundary_vertex=0, method="linear")
    v = cuv.unwrap(V, [other, one], place="disk", boundary_vertex=0, method="linear")
    np.testing.assert_allclose(u.uv, np.concatenate((v.uv[4:], v.uv[:4])), atol=1e-12)


def test_signs_spread_along_a_tree_by_the_parity_of_its_crossings() -> None:
    """A Moebius band of polygons wound at random: the cut leaves one strip, whose windings all agree."""
    rng = np.random.default_rng(0)
    for count in (5, 8, 13):
        turn = 2.0 * np.pi * np.arange(count) / count
        arm = 0.4 * np.column_stack(
            (np.cos(turn / 2) * np.cos(turn), np.cos(turn / 2) * np.sin(turn), np.sin(turn / 2))
        )
        middle = np.column_stack((np.cos(turn), np.sin(turn), 0.0 * turn))
        V = np.concatenate((middle - arm, middle + arm))
        k = np.arange(count)
        Q = np.column_stack((k, (k + 1) % count, (k + 1) % count + count, k + count))
        Q[-1] = [count - 1, count, 0, 2 * count - 1]
        for _ in range(5):
            mixed = np.where(rng.random((count, 1)) < 0.5, Q[:, ::-1], Q)
            (chart,) = cuv.unwrap(V, mixed, orientation="mend", method="linear").charts
            assert chart.status == "mapped" and not len(chart.flipped)
            assert len(chart.vertices) == 2 * count + 2  # cut across once: the two ends have their own vertices


def test_a_slit_of_the_circle_stays_open_where_a_hole_is_filled() -> None:
    """A seam from the rim of a plate of 5 x 5 quads without the middle one: both its sides lie on the circle."""
    V, Q = grid(5, 5)
    Q = np.delete(Q, 12, axis=0)
    (chart,) = cuv.unwrap(V, Q, seams=[[2, 8]], method="linear").charts
    assert chart.notes == ["1 hole filled for the solution"]
    assert len(chart.map.boundary) == 20 + 2
    hole_and_beside = [14, 13]
    (chart,) = cuv.unwrap(V, Q, seams=[[2, 8], hole_and_beside], method="linear").charts
    assert len(chart.map.boundary) == 20 + 2 and "seams that end inside the chart were closed" in chart.notes


def test_meshes_packed_together_keep_their_areas_to_each_other() -> None:
    """One of them has a hole that is filled for the solution: its image is less than its disk."""
    meshes = grid(6, 6), grid(7, 7)
    meshes = (
        meshes[0],
        (meshes[1][0], np.delete(meshes[1][1], [*range(15, 20), *range(22, 27), *range(29, 34)], axis=0)),
    )
    results = [cuv.unwrap(*mesh, place="disk", method="linear") for mesh in meshes]
    shares = []
    for (_, Q), uv in zip(meshes, cuv.pack_together(results, [np.array([True])] * 2), strict=True):
        x, y = np.moveaxis(uv.reshape(-1, 4, 2), -1, 0)
        image = 0.5 * (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum()
        shares.append(image / len(Q))  # unit quads
    assert shares[0] == pytest.approx(shares[1], rel=1e-9)


@pytest.mark.parametrize("elsewhere", [False, True])
def test_a_selection_that_touches_itself_is_refused_unless_others_hold_it_there(elsewhere: bool) -> None:
    """Two triangles that touch in vertex 0, and a third: far off, or between them."""
    V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [-1, 0, 0], [-1, -1, 0], [5, 5, 0], [6, 5, 0], [6, 6, 0.0]])
    third = [0, 2, 3] if elsewhere else [5, 6, 7]
    u = cuv.unwrap(V, [[0, 1, 2], [0, 3, 4], third], selection=[0, 1], place="disk")
    assert [type(chart.error) for chart in u.charts] == [type(None) if elsewhere else cuv.NonManifoldError] * 2


def test_vertices_of_a_chart_that_failed_may_be_named() -> None:
    """What it would have used them for can not be told; those of no use to any chart are refused."""
    V, Q = grid(3, 3)
    solid, faces = block(np.ones((1, 1, 1)))
    polygons = [*Q.tolist(), *(faces + len(V)).tolist()]
    points = np.concatenate((V, solid + [9.0, 0.0, 0.0]))
    u = cuv.unwrap(points, polygons, center=[5, len(V)], place="disk")
    assert [chart.status for chart in u.charts] == ["mapped", "failed"]
    with pytest.raises(cuv.OptionError, match="center"):
        cuv.unwrap(points, polygons, center=[0, len(V)], place="disk")


def test_a_hole_is_filled_from_its_middle() -> None:
    V, Q = grid(5, 5)
    V = V + [3.0, 2.0, 1.0]
    (chart,) = cuv.unwrap(V, np.delete(Q, 12, axis=0), method="linear").charts
    np.testing.assert_allclose(chart.mesh.V[len(chart.vertices) :], [V[Q[12]].mean(axis=0)], rtol=1e-15)


def test_a_bar_is_cut_from_end_to_end_wherever_its_numbers_begin() -> None:
    """The farthest of the farthest: nine steps along and one across each way, whichever vertex is the first."""
    V, Q = block(np.ones((9, 1, 1)))
    for first in range(0, len(V), 5):
        order = np.roll(np.arange(len(V)), -first)
        number = np.argsort(order)
        (chart,) = cuv.unwrap(V[order], number[Q], closed="cut", method="linear", place="disk").charts
        assert chart.notes == ["closed: cut open along 11 edges"]


def test_a_one_sided_chart_is_cut_beside_charts_that_need_no_cut() -> None:
    """The last polygon is of a plate: no tree of windings leads to it."""
    u = cuv.unwrap(*disjoint(moebius_band(8), plate(2, 2)), orientation="mend", method="linear")
    assert u.summary == "mapped 2 of 2 charts" and [len(chart.flipped) for chart in u.charts] == [0, 0]


def test_blocks_of_shelves_are_as_large_as_what_lies_in_them() -> None:
    """Boxes of very unequal sizes, named in no order of theirs."""
    size = np.array([1 + 1j, 3 + 2j, 1 + 4j, 2 + 1j, 1 + 1j, 5 + 3j, 1 + 2j])
    place, block, around = blocks_of_shelves(size, 5.0)
    assert len(around) == 3
    for number, found in enumerate(around):
        far = (place + size)[block == number]
        assert found == far.real.max() + 1j * far.imag.max()


def test_the_outer_loop_of_a_chart_with_a_fault_may_be_named() -> None:
    """A ring whose inner loop is chosen, and three triangles at one edge, whose loops are not known."""
    V, F = annulus(8)
    fin = [[16, 17, 18], [17, 16, 19], [16, 17, 20]]
    W = np.concatenate((V, [[9, 0, 0], [10, 0, 0], [9, 1, 0], [9, -1, 0], [9, 0, 1.0]]))
    u = cuv.unwrap(W, [*F.tolist(), *fin], outer_loop=[3, 18], place="disk")
    assert [type(chart.error) for chart in u.charts] == [type(None), cuv.NonManifoldError]
    assert sorted(u.charts[0].vertices[u.charts[0].map.boundary].tolist()) == list(range(8))


def test_a_seam_to_a_vertex_beyond_the_last_is_refused() -> None:
    """Of 12 vertices 0 and 17 are none of the edges, whatever number 0 x 12 + 17 is: that of the edge 1, 5."""
    V, Q = grid(3, 2)
    for seams in ([[0, 17]], [[1, 5], [0, 17]]):
        with pytest.raises(cuv.OptionError, match=r"^1 seams are not edges of the mesh: \(0, 17\)"):
            cuv.unwrap(V, Q, seams=seams)
