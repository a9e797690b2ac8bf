"""unwrap: closed forms, symmetry and what comes back for the caller's own polygons."""

from __future__ import annotations

import numpy as np
import pytest
from meshes import annulus, plate
from polygon_shapes import CUBE, CUBE_V, block, grid, side_by_side, sides_of, tube

from conformal_uv import CancelledError, OptionError, disk_map
from conformal_uv.charts import Unwrapper, unwrap
from conformal_uv.mesh.polygons import PolygonMesh
from conformal_uv.samples import mask, spherical_cap


def corner_uv(u, polygons):
    """The coordinates of each polygon's corners."""
    sizes = [len(q) for q in polygons]
    return np.split(u.uv, np.cumsum(sizes)[:-1])


def signed_area(uv):
    x, y = uv.T
    return 0.5 * float(x @ np.roll(y, -1) - np.roll(x, -1) @ y)


@pytest.mark.parametrize("method", ["linear", "newton"])
def test_one_disk_equals_disk_map_to_the_last_bit(method):
    V, F = mask(600)
    u, m = unwrap(V, F, place="disk", method=method, upright="none"), disk_map(V, F, method=method)
    assert np.array_equal(u.uv.reshape(-1, 3, 2), m.uv[F])
    assert np.array_equal(u.charts[0].map.boundary, m.boundary)


def test_one_disk_takes_the_options_of_disk_map():
    V, F = spherical_cap(400)
    loop = disk_map(V, F, method="linear").boundary
    interior = int(np.setdiff1d(np.arange(len(V)), loop)[5])
    pins = [int(loop[3]), int(loop[20]), int(loop[33])]
    for options in ({"center": interior, "boundary_vertex": int(loop[7])}, {"pins": pins}, {"objective": "dirichlet"}):
        u, m = unwrap(V, F, place="disk", upright="none", **options), disk_map(V, F, **options)
        assert np.array_equal(u.uv.reshape(-1, 3, 2), m.uv[F]), options
    swapped = unwrap(V, F, place="disk", pins=[pins[0], pins[2], pins[1]])
    assert np.array_equal(swapped.uv, unwrap(V, F, place="disk", pins=[pins]).uv)


def test_a_cube_cut_along_all_edges_gives_six_squares():
    u = unwrap(CUBE_V, CUBE, seams=sides_of(CUBE), place="disk")
    assert u.summary == "mapped 6 of 6 charts"
    assert u.chart_of_face.tolist() == [0, 1, 2, 3, 4, 5]
    for uv in corner_uv(u, CUBE):
        z = uv @ [1, 1j]
        assert np.abs(z) == pytest.approx(1.0)
        assert np.roll(z, -1) / z == pytest.approx(1j)  # a quarter turn from each corner to the next


def test_a_cube_cut_open_like_a_cross_is_one_chart():
    flat = {(0, 1), (0, 2), (1, 3), (2, 3), (2, 6), (3, 7), (4, 6), (5, 7)}
    hinges = {(0, 1), (0, 2), (1, 3), (2, 3), (4, 5)}
    assert len(flat | hinges) == 9
    edges = {tuple(sorted(e)) for e in sides_of(CUBE).tolist()}
    u = unwrap(CUBE_V, CUBE, seams=sorted(edges - hinges), place="disk")
    assert u.summary == "mapped 1 of 1 chart" and not len(u.charts[0].flipped)
    assert len(u.charts[0].vertices) == 14  # the net of a cube
    assert all(signed_area(uv) > 0 for uv in corner_uv(u, CUBE))


def test_concave_polygons_and_mixed_sizes_keep_their_corners():
    V = np.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [1, 0.5, 0], [0, 2, 0], [1, 3, 0], [3, 1, 0]], dtype=float)
    polygons = [[0, 1, 2, 3, 4], [4, 3, 2, 5], [1, 6, 2]]
    u = unwrap(V, polygons, place="disk")
    assert u.uv.shape == (12, 2) and u.mapped.all()
    seen = {}
    for polygon, uv in zip(polygons, corner_uv(u, polygons), strict=True):
        assert signed_area(uv) > 0
        for vertex, position in zip(polygon, uv.tolist(), strict=True):
            assert seen.setdefault(vertex, position) == position  # no cut: one position for each vertex
    u2 = unwrap(None, PolygonMesh(V, np.concatenate(polygons), np.array([0, 5, 9, 12])), place="disk")
    assert np.array_equal(u.uv, u2.uv)


def test_a_selection_leaves_the_other_corners_alone():
    V, Q = grid(6, 5)
    V[3] = np.nan  # used by faces 2 and 3 only
    chosen = np.array([7, 8, 13, 14, 29])
    u = unwrap(V, Q, selection=chosen, place="disk")
    assert np.flatnonzero(u.mapped).tolist() == chosen.tolist()
    assert u.chart_of_face[chosen].tolist() == [0, 0, 0, 0, 1]
    assert (np.delete(u.chart_of_face, chosen) == -1).all()
    assert not np.delete(u.uv.reshape(-1, 4, 2), chosen, axis=0).any()
    assert [c.faces.tolist() for c in u.charts] == [[7, 8, 13, 14], [29]]
    mask_form = unwrap(V, Q, selection=np.isin(np.arange(30), chosen), place="disk")
    assert np.array_equal(mask_form.uv, u.uv)


def test_quads_that_touch_at_a_corner_of_the_selection_are_not_refused():
    V, Q = grid(2, 2)
    u = unwrap(V, Q, selection=[0, 3])
    assert u.summary == "mapped 2 of 2 charts"


def test_a_flat_annulus_filled_maps_to_itself():
    V, F = annulus(16)
    u = unwrap(V, F, place="disk")
    radius = np.abs(u.uv @ [1, 1j])[np.argsort(F.reshape(-1), kind="stable")]
    inner = np.repeat(np.arange(32) < 16, np.bincount(F.reshape(-1)))
    assert radius[inner] == pytest.approx(0.5, abs=1e-9)
    assert radius[~inner] == pytest.approx(1.0, abs=1e-12)
    assert u.charts[0].notes == ["1 hole filled for the solution"]
    assert u.charts[0].distortion.angle_max < 1e-6


def test_the_outer_loop_can_be_chosen():
    V, F = annulus(16)
    u = unwrap(V, F, place="disk", outer_loop=3)
    z = np.zeros(32, dtype=complex)
    z[F.reshape(-1)] = u.uv @ [1, 1j]
    assert np.abs(z[:16]) == pytest.approx(1.0, abs=1e-12)
    assert np.ptp(np.abs(z[16:])) < 1e-3 and np.abs(z[16:]).max() < 1  # still a ring, turned inside out
    assert not len(u.charts[0].flipped)


def test_three_holes_lie_inside_the_circle_of_the_longest_loop():
    holes = ((2, 2, 2, 2), (6, 3, 3, 1), (8, 7, 1, 1))
    V, F = plate(12, 10, holes)
    u = unwrap(V, F, place="disk")
    z = np.zeros(len(V), dtype=complex)
    z[F.reshape(-1)] = u.uv @ [1, 1j]
    rim = (V[:, 0] % 12 == 0) | (V[:, 1] % 10 == 0)
    assert np.abs(z[rim]) == pytest.approx(1.0, abs=1e-12)
    assert np.abs(z[~rim]).max() < 0.99
    assert u.charts[0].notes == ["3 holes filled for the solution"] and not len(u.charts[0].flipped)


def test_seams_that_end_inside_are_closed_again():
    V, Q = grid(6, 6)
    slits = [(15, 16), (16, 17), (17, 18), (18, 19), (29, 30), (30, 37), (30, 31), (39, 40)]
    u, plain = unwrap(V, Q, seams=slits, place="disk"), unwrap(V, Q, place="disk")
    assert u.uv == pytest.approx(plain.uv, abs=1e-12)
    assert u.charts[0].notes == ["seams that end inside the chart were closed"]


def test_a_seam_from_the_boundary_stays_open():
    V, Q = grid(6, 6)
    u = unwrap(V, Q, seams=[(3, 10), (10, 17)], place="disk")
    assert len(u.charts[0].vertices) == len(V) + 2
    assert len(u.charts[0].map.boundary) == 24 + 4


def test_a_tube_opened_by_a_seam_of_its_quads():
    V, Q = tube(12, 8, 3.0)
    seam = 12 * np.arange(9)
    u = unwrap(V, Q, seams=np.column_stack((seam[:-1], seam[1:])), place="disk", center=int(12 * 4 + 6))
    assert u.summary == "mapped 1 of 1 chart" and len(u.charts[0].vertices) == len(V) + 9
    z = {int(v): [] for v in range(len(V))}
    for v, w in zip(Q.reshape(-1), u.uv @ [1, 1j], strict=True):
        z[int(v)].append(w)
    for v in seam:
        left, right = np.unique(np.round(z[int(v)], 9))
        assert abs(left - right) > 0.1
    assert z[54][0] == 0.0


def test_polygon_order_does_not_matter():
    V, Q = side_by_side(3)
    order = np.random.default_rng(4).permutation(len(Q))
    options = {"center": [5, 17, 29], "boundary_vertex": [0, 12, 24], "place": "disk"}
    u, other = unwrap(V, Q, **options), unwrap(V, Q[order], **options)
    assert other.uv.reshape(-1, 4, 2) == pytest.approx(u.uv.reshape(-1, 4, 2)[order], abs=1e-9)


def test_rotation_turns_every_disk_about_its_centre():
    V, Q = side_by_side(2)
    straight, turned = unwrap(V, Q), unwrap(V, Q, rotation=0.3)
    for k, chart in enumerate(straight.charts):
        corners = np.repeat(straight.chart_of_face == k, 4)
        centre = complex(*chart.placement.center)
        before, after = (u.uv[corners] @ [1, 1j] - centre for u in (straight, turned))
        assert after == pytest.approx(before * np.exp(0.3j), abs=1e-12)


def test_vertices_find_their_charts():
    V, Q = side_by_side(3)
    # Each grid has 12 vertices, 5 and 6 inside; the boundary of grid k runs from 12 k.
    u = unwrap(V, Q, place="disk", center=[17], pins=[[24, 27, 35]], boundary_vertex=[14])
    _, second, third = u.charts
    with pytest.raises(OptionError, match="pins: no chart can use vertices 3;"):
        unwrap(V, Q, pins=[[24, 27, 35], [3]])
    assert second.map.uv[5] == pytest.approx([0, 0]) and second.map.uv[2] == pytest.approx([1, 0])
    roots = np.exp(2j * np.pi / 3 * np.arange(3))
    assert third.map.uv[[0, 3, 11]] @ [1, 1j] == pytest.approx(roots)
    backwards = unwrap(V, Q, place="disk", pins=[24, 35, 27])
    assert np.array_equal(backwards.charts[2].map.uv, third.map.uv)
    assert backwards.charts[2].notes == ["pins taken in the order of the boundary: 24, 27, 35"]


def test_a_centre_on_the_boundary_is_noted():
    V, Q = grid(3, 3)
    u = unwrap(V, Q, center=[0, 5, 6], place="disk")
    assert u.charts[0].map.center == 5
    assert u.charts[0].notes == ["center 0, 6 not used: one is enough"]


NOT_USABLE = [{"center": 0}, {"boundary_vertex": 5}, {"pins": [0, 1, 5]}, {"pins": [0, 1, 2, 3]}]


@pytest.mark.parametrize("options", NOT_USABLE)
def test_a_vertex_that_no_chart_can_use_is_refused(options: dict[str, object]) -> None:
    V, Q = grid(3, 3)
    with pytest.raises(OptionError, match="no chart can use"):
        unwrap(V, Q, **options)


@pytest.mark.parametrize(
    "options",
    [{"rotation": "a"}, {"margin": "a"}, {"margin": np.nan}, {"rotation": None}, {"tolerance": "1"}, {"place": 3}],
)
def test_options_of_other_types_are_refused(options: dict[str, object]) -> None:
    V, Q = grid(3, 3)
    with pytest.raises(OptionError):
        unwrap(V, Q, **options)


def test_fit_fills_the_unit_square_and_keeps_the_margin():
    V, F = mask(300)
    disk = unwrap(V, F, place="disk")
    assert unwrap(V, F, margin=0.0).uv == pytest.approx(0.5 + 0.5 * disk.uv)
    assert unwrap(V, F, margin=0.1).uv == pytest.approx(0.5 + 0.4 * disk.uv)


def test_unwrapper_factorizes_each_chart_once(monkeypatch):
    from conformal_uv.operators import dirichlet

    count = []
    real = dirichlet.linear_solver
    monkeypatch.setattr(dirichlet, "linear_solver", lambda *a, **k: count.append(1) or real(*a, **k))
    V, F = mask(300)
    W = np.concatenate((V, V + [1.0, 0.0, 0.0]))
    G = np.concatenate((F, F + len(V)))
    again = Unwrapper(W, G)
    first = again.unwrap(place="disk")
    assert len(count) == 2
    linear = again.unwrap(method="linear", place="disk", rotation=1.0)
    inside = int(np.setdiff1d(np.arange(len(V)), first.charts[0].map.boundary)[0])
    moved = again.unwrap(center=inside, place="pack")
    assert len(count) == 2
    assert np.array_equal(linear.uv, unwrap(W, G, method="linear", place="disk", rotation=1.0).uv)
    assert np.array_equal(first.uv, again.unwrap(place="disk").uv)
    assert not np.array_equal(first.uv, moved.uv)


def test_a_two_sided_card_and_a_doublet_are_seen_as_what_they_are():
    V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 1, 0.8]])
    u = unwrap(V, [[0, 1, 2, 3], [2, 1, 0, 4]], place="disk")  # both would be cut from 0 to 2
    assert u.summary == "mapped 1 of 1 chart" and not len(u.charts[0].flipped)
    assert u.charts[0].F.tolist() == [[0, 1, 2], [0, 2, 3], [2, 1, 0], [2, 0, 4]]
    u = unwrap(V, [[0, 1, 2, 3], [3, 2, 1, 0]])
    assert type(u.charts[0].error).__name__ == "DuplicateFaceError"


def test_progress_never_falls_and_can_cancel():
    V, Q = side_by_side(4)
    seen = []
    unwrap(V, Q, callback=lambda stage, fraction: seen.append((stage, fraction)))
    fractions = [fraction for _, fraction in seen]
    assert fractions == sorted(fractions) and fractions[0] == 0.0 and fractions[-1] == 1.0
    assert {"charts", "newton", "packing"} <= {stage for stage, _ in seen}
    with pytest.raises(CancelledError):
        unwrap(V, Q, callback=lambda stage, fraction: fraction < 0.5)


def test_nothing_of_the_caller_is_changed():
    V, Q = block(np.ones((2, 2, 1)))
    before = V.copy(), Q.copy()
    unwrap(V, Q, closed="cut", orientation="mend", nonmanifold="cut")
    assert np.array_equal(V, before[0]) and np.array_equal(Q, before[1])
