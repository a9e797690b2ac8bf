"""unwrap: closed pieces, handles, non-manifold places and windings, refused with the reason or mended."""

from __future__ import annotations

import numpy as np
import pytest
from meshes import glued, icosahedron, moebius_band, plate, tetrahedron, torus
from polygon_shapes import CUBE, CUBE_V, block, grid, rings, sides_of, tube

from conformal_uv import (
    DuplicateFaceError,
    NonManifoldError,
    OrientationError,
    TopologyError,
)
from conformal_uv.charts import cut_graph, unwrap
from conformal_uv.mesh.surface import Surface

CLOSED = {
    "cube": (CUBE_V, CUBE, 0),
    "tetrahedron": (*tetrahedron(), 0),
    "icosahedron": (*icosahedron(), 0),
    "block": (*block(np.ones((4, 3, 2))), 0),
    "torus": (*torus(12, 9), 1),
    "ring": (*rings(1), 1),
    "two rings": (*rings(2), 2),
    "three rings": (*rings(3, 2), 3),
}


def fin():
    """A plate with a triangle standing on one of its inner edges; the fin is the last face."""
    V, F = plate(4, 4)
    return np.vstack((V, [[2.5, 2.0, 1.0]])), np.vstack((F, [[12, 13, len(V)]]))


def edge_count(F) -> dict[tuple[int, int], int]:
    pairs, count = np.unique(np.sort(sides_of(F), axis=1), axis=0, return_counts=True)
    return {tuple(pair): int(k) for pair, k in zip(pairs.tolist(), count, strict=True)}


@pytest.mark.parametrize("name", CLOSED)
def test_closed_pieces_are_refused_with_their_genus(name):
    V, Q, genus = CLOSED[name]
    u = unwrap(V, Q)
    assert not u.mapped.any() and not u.uv.any()
    assert type(u.charts[0].error) is TopologyError
    assert f"closed, of genus {genus}" in str(u.charts[0].error)


@pytest.mark.parametrize("name", CLOSED)
def test_closed_pieces_are_cut_into_one_disk(name):
    V, Q, genus = CLOSED[name]
    u = unwrap(V, Q, closed="cut", place="disk", laplacian="intrinsic-delaunay")
    assert u.summary == "mapped 1 of 1 chart" and u.mapped.all()
    chart = u.charts[0]
    assert not len(chart.flipped)
    surface = Surface.from_arrays(chart.mesh.V, chart.mesh.solved)  # an independent look at what was mapped
    assert len(surface.require_disk()) == len(chart.map.boundary)
    # Both sides of the cut: one point of space, several of the disk. No diagonal was cut.
    vertices, copies = np.unique(chart.vertices, return_counts=True)
    assert np.array_equal(vertices, np.unique(Q)) and (copies > 1).any()
    assert np.array_equal(chart.mesh.V[: len(chart.vertices)], V[chart.vertices])
    sides = {tuple(sorted(e)) for e in sides_of(Q).tolist()}
    loop = chart.vertices[chart.map.boundary]
    assert {tuple(sorted(e)) for e in np.column_stack((loop, np.roll(loop, -1))).tolist()} <= sides
    if genus:  # no loose ends
        assert np.isin(loop, vertices[copies > 1]).all()
    for v in vertices[copies > 1]:
        z = chart.map.uv[np.flatnonzero(chart.vertices == v)] @ [1, 1j]
        assert np.unique(np.round(z, 12)).size == z.size


def test_a_sphere_is_cut_between_far_ends_along_a_shortest_path():
    V, Q = block(np.ones((6, 1, 1)))
    u = unwrap(V, Q, closed="cut")
    cut = u.charts[0].vertices[u.charts[0].map.boundary]
    assert np.ptp(V[cut][:, 0]) == 6.0
    assert u.charts[0].notes == ["closed: cut open along 8 edges"]  # 6 along, 1 + 1 across: from corner to corner


def test_a_torus_is_cut_along_two_short_loops():
    V, F = torus(24, 10)
    u = unwrap(V, F, closed="cut")
    chart = u.charts[0]
    loop = chart.vertices[chart.map.boundary]
    length = np.linalg.norm(V[loop] - V[np.roll(loop, -1)], axis=1).sum() / 2
    assert length < 1.15 * 2 * np.pi * (1.3 + 0.7)  # around the hole, and around the tube


def test_a_surface_with_a_handle_and_boundary_is_cut_from_its_boundary():
    V, Q = rings(2, 2)
    Q = np.delete(Q, [3, 40], axis=0)
    u = unwrap(V, Q)
    assert "of genus 2; a disk has no handles" in str(u.charts[0].error)
    u = unwrap(V, Q, closed="cut", laplacian="intrinsic-delaunay")
    assert u.mapped.all() and not len(u.charts[0].flipped)
    assert u.charts[0].notes[0] == "1 hole filled for the solution"
    assert u.charts[0].notes[1].startswith("genus 2: cut open along")


def test_several_holes_are_refused_with_their_loops():
    V, F = plate(12, 10, ((2, 2, 2, 2), (8, 7, 1, 1)))
    u = unwrap(V, F, holes="refuse")
    error = u.charts[0].error
    assert type(error) is TopologyError and "3 boundary loops" in str(error)
    assert len(error.indices) == 3
    assert unwrap(*tube(8, 3, 1.0)).summary == "mapped 1 of 1 chart"


def test_an_edge_of_three_faces():
    V, F = fin()
    refused = unwrap(V, F)
    error = refused.charts[0].error
    assert type(error) is NonManifoldError and "(12, 13)" in str(error)
    around = [f for f in range(len(F)) if {12, 13} <= set(F[f].tolist())]
    assert error.indices == tuple(around) and len(around) == 3
    u = unwrap(V, F, nonmanifold="cut", place="disk")
    assert u.summary == "mapped 2 of 2 charts"
    assert u.chart_of_face.tolist() == [0] * 32 + [1]
    # The plate goes on under the fin: it maps as if there were none.
    assert np.array_equal(u.uv[:96], unwrap(V, F[:-1], place="disk").uv)


def test_a_seam_on_a_crowded_edge_is_enough():
    V, F = fin()
    assert unwrap(V, F, seams=[(13, 12)]).summary == "mapped 2 of 2 charts"


def test_parts_that_touch_in_a_vertex():
    V, F = glued(plate(2, 2), plate(2, 2), [(8, 0)])
    V = np.concatenate((V, V + [20.0, 0.0, 0.0]))
    F = np.concatenate((F, F[:8] + len(V) // 2))
    u = unwrap(V, F)
    assert [c.status for c in u.charts] == ["failed", "failed", "mapped"]
    for chart in u.charts[:2]:
        assert type(chart.error) is NonManifoldError and "vertices 8 of faces" in str(chart.error)
        assert set(chart.error.indices) == {f for f in chart.faces.tolist() if 8 in F[f]}
    u = unwrap(V, F, nonmanifold="cut")
    assert u.mapped.all()


def test_a_chart_that_touches_itself_in_a_vertex():
    V, F = plate(5, 5, ((1, 1, 1, 1), (2, 2, 1, 1)))  # two holes that meet in a corner
    u = unwrap(V, F)
    assert type(u.charts[0].error) is NonManifoldError
    u = unwrap(V, F, nonmanifold="cut")
    assert u.mapped.all() and u.charts[0].notes == ["1 hole filled for the solution"]  # the two have become one


def test_a_face_wound_against_the_rest():
    V, F = plate(4, 4)
    G = F.copy()
    G[5] = G[5][::-1]
    error = unwrap(V, G).charts[0].error
    assert type(error) is OrientationError and error.indices == (5,)
    u, straight = unwrap(V, G, orientation="mend", place="disk"), unwrap(V, F, place="disk")
    uv = u.uv.reshape(-1, 3, 2)
    uv[5] = uv[5, ::-1]
    assert uv == pytest.approx(straight.uv.reshape(-1, 3, 2), abs=1e-9)
    assert u.charts[0].notes == ["1 faces wound against the rest were turned: faces 5"]


@pytest.mark.parametrize("polygons", ["triangles", "quads"])
def test_a_moebius_band_is_cut_across(polygons):
    V, F = moebius_band(12)
    Q = F if polygons == "triangles" else np.column_stack((F[:12], F[12:, 2]))
    error = unwrap(V, Q).charts[0].error
    assert type(error) is OrientationError and "one side" in str(error)
    u = unwrap(V, Q, orientation="mend", place="disk")
    # A band ten times as long as wide crowds its far corners: gaps of 1e-9 radians leave areas of 1e-28 to doubles.
    assert u.mapped.all() and np.isin(u.charts[0].flipped, u.charts[0].map.lost_to_double).all()
    assert len(u.charts[0].flipped) <= 1
    assert u.charts[0].notes[-1] == "one-sided: cut where the two windings meet"
    assert len(u.charts[0].vertices) == len(V) + 2
    # Corners of a face go once around it, one way or the other, and keep their places in space.
    assert len(np.unique(u.uv, axis=0)) == len(V) + 2
    seamed = unwrap(V, Q, seams=[(0, 12)], orientation="mend")
    assert seamed.mapped.all() and not any("one-sided" in note for note in seamed.charts[0].notes)


def test_faces_that_stand_twice():
    V, F = plate(3, 3)
    u = unwrap(V, np.vstack((F, F[4:5])))
    assert type(u.charts[0].error) is DuplicateFaceError and u.charts[0].error.indices == (4, len(F))


def test_a_soup_of_triangles():
    P = np.random.default_rng(0).random((30, 3))
    u = unwrap(P, np.arange(30).reshape(-1, 3), place="disk")
    assert len(u.charts) == 10 and u.mapped.all()
    assert np.abs(u.uv @ [1, 1j]) == pytest.approx(1.0)


def test_seams_in_a_grid_cut_it_into_cells():
    V, Q = grid(6, 6)
    lines = [(7 * r + c, 7 * r + c + 1) for r in (2, 4) for c in range(6)]
    lines += [(7 * r + c, 7 * (r + 1) + c) for r in range(6) for c in (2, 4)]
    u = unwrap(V, Q, seams=lines)
    assert len(u.charts) == 9 and u.mapped.all()
    assert all(len(chart.faces) == 4 for chart in u.charts)
    assert [chart.faces[0] for chart in u.charts] == sorted(chart.faces[0] for chart in u.charts)
    assert edge_count(Q)[(14, 15)] == 2


@pytest.mark.parametrize("name", ["torus", "ring", "two rings", "three rings"])
def test_a_cut_graph_has_no_loose_ends_wherever_it_grows_from(name, monkeypatch):
    monkeypatch.setattr(cut_graph, "MOST_ROOTS", 1)
    V, Q, _ = CLOSED[name]
    for first in range(0, len(V), 5):
        relabelled = (np.arange(len(V)) - first) % len(V)
        W = np.empty_like(V)
        W[relabelled] = V
        chart = unwrap(W, relabelled[Q], closed="cut", method="linear", place="disk").charts[0]
        vertices, copies = np.unique(chart.vertices, return_counts=True)
        assert chart.map is not None
        assert np.isin(chart.vertices[chart.map.boundary], vertices[copies > 1]).all()
