"""The filter on MeshSets: what it writes, and what it leaves alone."""

from __future__ import annotations

import numpy as np
import pytest

try:
    import pymeshlab
except ImportError:
    pytest.skip("pymeshlab is not installed", allow_module_level=True)

from meshes import annulus, disjoint, octahedron, plate, tetrahedron
from meshlab_sets import TEXCOORDS, changed, contents, mesh_set, wedges
from polygon_shapes import CUBE, CUBE_V, grid

import conformal_uv as cuv
from conformal_uv.samples import mask
from meshlab_filter import ConformalFilterException
from meshlab_filter import compute_texcoord_parametrization_conformal_disk as conformal_disk
from meshlab_filter.current_mesh import read_current_mesh


@pytest.fixture
def face_of_mask():
    return mask(600)


def test_writes_the_coordinates_of_unwrap_and_nothing_else(face_of_mask):
    V, F = face_of_mask
    ms = mesh_set(V, F)
    before = contents(ms)
    numbers = conformal_disk(ms)
    assert changed(before, contents(ms)) == set(TEXCOORDS)
    expected = cuv.unwrap(V, F)
    np.testing.assert_array_equal(wedges(ms).reshape(-1, 2), expected.uv.astype(np.float32))
    np.testing.assert_array_equal(ms.current_mesh().vertex_tex_coord_matrix()[F], wedges(ms))
    chart = expected.charts[0]
    assert numbers["conformal_energy"] == chart.map.conformal_energy
    assert numbers["angle_error_mean"] == pytest.approx(chart.distortion.angle_mean, rel=1e-14)  # another order of sums
    assert (numbers["charts"], numbers["mapped_charts"], numbers["converged_charts"]) == (1, 1, 1)
    assert (numbers["faces"], numbers["mapped_faces"], numbers["torn_vertices"]) == (len(F), len(F), 0)
    assert numbers["flipped_polygons"] == numbers["lost_to_float32"] == 0
    assert all(isinstance(value, int | float) for value in numbers.values())


def test_again_with_other_options_replaces_the_coordinates(face_of_mask):
    V, F = face_of_mask
    ms = mesh_set(V, F)
    conformal_disk(ms)
    first = wedges(ms).copy()
    conformal_disk(ms, center=300, place="disk", upright="none")
    uv = ms.current_mesh().vertex_tex_coord_matrix()
    np.testing.assert_array_equal(uv, cuv.disk_map(V, F, center=300).uv.astype(np.float32))
    conformal_disk(ms)
    np.testing.assert_array_equal(wedges(ms), first)


def test_wedges_hold_what_vertices_can_not_where_a_surface_is_cut():
    V, F = octahedron()
    ms = mesh_set(V, F)
    numbers = conformal_disk(ms, closed="cut")
    expected = cuv.unwrap(V, F, closed="cut").uv.astype(np.float32).reshape(-1, 3, 2)
    np.testing.assert_array_equal(wedges(ms), expected)
    uv = ms.current_mesh().vertex_tex_coord_matrix()
    torn = {v for v in range(6) if (expected[v == F] != expected[v == F][0]).any()}
    assert numbers["torn_vertices"] == len(torn) > 0
    for v in range(6):
        np.testing.assert_array_equal(uv[v], expected[v == F][0])  # the first of its faces'


def test_pieces_become_charts_of_one_texture():
    V, F = disjoint(plate(4, 3), plate(5, 2))
    ms = mesh_set(V, F)
    numbers = conformal_disk(ms)
    assert numbers["charts"] == numbers["mapped_charts"] == 2 and numbers["torn_vertices"] == 0
    assert (wedges(ms) >= 0).all() and (wedges(ms) <= 1).all()
    np.testing.assert_array_equal(wedges(ms).reshape(-1, 2), cuv.unwrap(V, F).uv.astype(np.float32))


def test_a_failed_piece_keeps_its_coordinates_and_is_logged(caplog):
    V, F = disjoint(plate(4, 3), tetrahedron())
    old = np.linspace(0, 1, 6 * len(F)).reshape(-1, 2)
    ms = mesh_set(V, F, w_tex_coords_matrix=old)
    with caplog.at_level("WARNING", "meshlab_filter"):
        numbers = conformal_disk(ms)
    assert (numbers["charts"], numbers["mapped_charts"], numbers["mapped_faces"]) == (2, 1, len(F) - 4)
    np.testing.assert_array_equal(wedges(ms)[-4:].reshape(-1, 2), old[-12:].astype(np.float32))
    np.testing.assert_array_equal(wedges(ms)[:-4].reshape(-1, 2), cuv.unwrap(V, F).uv[:-12].astype(np.float32))
    assert "mapped 1 of 2 charts" in caplog.text and "closed" in caplog.text


def test_selected_only_leaves_the_other_faces():
    V, F = plate(6, 6)
    old = np.linspace(0, 1, 6 * len(F)).reshape(-1, 3, 2)
    ms = mesh_set(V, F, w_tex_coords_matrix=old.reshape(-1, 2))
    ms.compute_selection_by_condition_per_face(condselect="x0 + x1 + x2 < 8")
    selected = ms.current_mesh().face_selection_array()
    assert 0 < selected.sum() < len(F)
    before = contents(ms)
    numbers = conformal_disk(ms, selected_only=True)
    assert changed(before, contents(ms)) == set(TEXCOORDS)
    assert numbers["mapped_faces"] == selected.sum()
    expected = cuv.unwrap(V, F, selection=selected).uv.reshape(-1, 3, 2)
    np.testing.assert_array_equal(wedges(ms)[selected], expected[selected].astype(np.float32))
    np.testing.assert_array_equal(wedges(ms)[~selected], old[~selected].astype(np.float32))


def test_pins_seams_and_holes_reach_the_map():
    V, F = plate(6, 6, holes=((2, 2, 1, 1),))
    ms = mesh_set(V, F)
    seams = [(0, 1), (7, 8)]
    rim = cuv.unwrap(V, F, seams=seams, method="linear").charts[0]
    a, b, c = rim.vertices[rim.map.boundary[[0, 5, 11]]].tolist()
    options = {"pins": [a, b, c], "seams": seams, "place": "disk", "method": "linear"}
    conformal_disk(ms, **options)
    np.testing.assert_array_equal(wedges(ms).reshape(-1, 2), cuv.unwrap(V, F, **options).uv.astype(np.float32))
    with pytest.raises(ConformalFilterException, match="boundary"):
        conformal_disk(ms, holes="refuse")


def test_no_trace_is_left_in_the_filter_script(tmp_path, face_of_mask):
    """What was recorded before can be saved and replayed on another mesh."""
    V, F = face_of_mask
    ms = mesh_set(V, F)
    ms.apply_coord_laplacian_smoothing()
    before, after = tmp_path / "before.mlx", tmp_path / "after.mlx"
    ms.save_filter_script(str(before))
    conformal_disk(ms, quality="angle")
    ms.save_filter_script(str(after))
    assert after.read_text() == before.read_text()
    other = mesh_set(V, F)
    other.load_filter_script(str(after))
    other.apply_filter_script()
    assert not np.array_equal(other.current_mesh().vertex_matrix(), V)


@pytest.mark.parametrize("selected_only", ["no", "false", 0, None])
def test_selected_only_is_true_or_false(face_of_mask, selected_only):
    with pytest.raises(ConformalFilterException, match="selected_only"):
        conformal_disk(mesh_set(*face_of_mask), selected_only=selected_only)


@pytest.mark.parametrize("columns, rows", [(5, 4)])
def test_quads_are_mapped_as_quads(columns: int, rows: int, tmp_path):
    V, Q = grid(columns, rows)
    V[:, 2] = 0.3 * np.sin(V[:, 0] + 0.5 * V[:, 1])
    text = "".join("v {:.17g} {:.17g} {:.17g}\n".format(*v) for v in V)
    (tmp_path / "quads.obj").write_text(text + "".join("f {} {} {} {}\n".format(*(q + 1)) for q in Q))
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(tmp_path / "quads.obj"))
    mesh = ms.current_mesh()
    assert len(mesh.polygonal_face_list()) == len(Q) and mesh.face_number() == 2 * len(Q)
    numbers = conformal_disk(ms)
    listed = np.array(mesh.polygonal_face_list(), dtype=int)
    assert {frozenset(q) for q in listed.tolist()} == {frozenset(q) for q in Q.tolist()}
    of_vertex = np.zeros((len(V), 2))
    of_vertex[listed] = cuv.unwrap(V, listed).uv.reshape(-1, 4, 2)
    np.testing.assert_array_equal(mesh.vertex_tex_coord_matrix(), of_vertex.astype(np.float32))
    np.testing.assert_array_equal(wedges(ms), of_vertex[mesh.face_matrix()].astype(np.float32))
    assert sorted(map(len, mesh.polygonal_face_list())) == [4] * len(Q)
    assert numbers["mapped_faces"] == 2 * len(Q)


def test_a_closed_mesh_of_quads_is_cut_along_its_own_edges(tmp_path):
    """No cut runs through a quad: the two triangles of each agree at their hidden edge."""
    text = "".join("v {} {} {}\n".format(*v) for v in CUBE_V)
    (tmp_path / "cube.obj").write_text(text + "".join("f {} {} {} {}\n".format(*(q + 1)) for q in CUBE))
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(tmp_path / "cube.obj"))
    conformal_disk(ms, closed="cut", selected_only=False)
    F, uv = ms.current_mesh().face_matrix(), wedges(ms)
    for polygon in CUBE:
        mine = np.flatnonzero(np.isin(F, polygon).all(axis=1))
        assert len(mine) == 2
        for v in set(F[mine[0]]) & set(F[mine[1]]):
            np.testing.assert_array_equal(uv[mine[0]][F[mine[0]] == v], uv[mine[1]][F[mine[1]] == v])


def test_attributes_of_the_users_under_our_names_are_left_alone():
    V, F = plate(3, 3)
    ms = mesh_set(V, F)
    ms.current_mesh().add_vertex_custom_scalar_attribute(np.full(len(V), 7.0), "conformal_uv_u")
    ms.current_mesh().add_vertex_custom_point_attribute(np.full((len(V), 3), 7.0), "conformal_uv_v")
    conformal_disk(ms)
    np.testing.assert_array_equal(wedges(ms).reshape(-1, 2), cuv.unwrap(V, F).uv.astype(np.float32))
    np.testing.assert_array_equal(ms.current_mesh().vertex_custom_scalar_attribute_array("conformal_uv_u"), 7.0)


def test_a_hole_is_filled_for_the_solution_only():
    V, F = annulus(12)
    ms = mesh_set(V, F)
    numbers = conformal_disk(ms)
    assert numbers["mapped_faces"] == len(F) == ms.current_mesh().face_number()
    outer = ms.current_mesh().vertex_tex_coord_matrix()[12:] - 0.5
    np.testing.assert_allclose(np.hypot(*outer.T), 0.5, rtol=1e-6)  # on the circle, in float32


def test_a_polygon_is_selected_by_all_of_its_triangles(tmp_path):
    """Six quads, of the first of which one of two triangles is selected, of the second both."""
    V, Q = grid(3, 2)
    text = "".join("v {:.17g} {:.17g} {:.17g}\n".format(*v) for v in V)
    (tmp_path / "quads.obj").write_text(text + "".join("f {} {} {} {}\n".format(*(q + 1)) for q in Q))
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(tmp_path / "quads.obj"))
    polygon = read_current_mesh(ms).wedges.polygon
    chosen = [np.flatnonzero(polygon == 0)[0], *np.flatnonzero(polygon == 1)]
    ms.compute_selection_by_condition_per_face(condselect=" || ".join(f"fi == {f}" for f in chosen))
    assert ms.current_mesh().face_selection_array().sum() == 3
    assert read_current_mesh(ms).selected_polygons().tolist() == [False, True, False, False, False, False]
