"""The filter on MeshSets: what it writes, what it leaves alone, what it raises."""

from __future__ import annotations

import inspect

import numpy as np
import pytest

pymeshlab = pytest.importorskip("pymeshlab", reason="pymeshlab is not installed", exc_type=ImportError)

from meshes import annulus, disjoint, fan, octahedron, plate, strip, tetrahedron  # noqa: E402
from meshlab_sets import TEXCOORDS, changed, contents, mesh_set  # noqa: E402
from polygon_shapes import grid  # noqa: E402

import conformal_uv as cuv  # noqa: E402
import meshlab_filter  # noqa: E402
from conformal_uv.samples import mask  # noqa: E402
from meshlab_filter import ConformalFilterException  # noqa: E402
from meshlab_filter import compute_texcoord_parametrization_conformal_disk as conformal_disk  # noqa: E402

NAME = "compute_texcoord_parametrization_conformal_disk"


@pytest.fixture
def face_of_mask():
    return mask(600)


def wedges(ms) -> np.ndarray:
    return ms.current_mesh().wedge_tex_coord_matrix().reshape(-1, 3, 2)


def texture_indices(ms) -> set[float]:
    ms.compute_new_custom_scalar_attribute_per_face(name="texture_index", expr="ti")
    return set(ms.current_mesh().face_custom_scalar_attribute_array("texture_index"))


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
    conformal_disk(ms, center=300, place="disk")
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
    options = {"pins": [0, 6, 40], "seams": seams, "place": "disk", "method": "linear"}
    conformal_disk(ms, **options)
    np.testing.assert_array_equal(wedges(ms).reshape(-1, 2), cuv.unwrap(V, F, **options).uv.astype(np.float32))
    with pytest.raises(ConformalFilterException, match="boundary"):
        conformal_disk(ms, holes="refuse")


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
    from polygon_shapes import CUBE, CUBE_V

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


def test_quality_is_the_distortion_of_each_face(face_of_mask):
    V, F = face_of_mask
    ms = mesh_set(V, F)
    before = contents(ms)
    distortion = cuv.unwrap(V, F).charts[0].distortion
    conformal_disk(ms, quality="angle")
    assert changed(before, contents(ms)) == {*TEXCOORDS, "face_scalars"}
    np.testing.assert_array_equal(ms.current_mesh().face_scalar_array(), distortion.angle_error.mean(axis=1))
    conformal_disk(ms, quality="quasi-conformal")
    np.testing.assert_array_equal(ms.current_mesh().face_scalar_array(), distortion.quasi_conformal)


def test_quality_is_finite_where_a_face_has_no_area():
    V, F = plate(4, 4)
    V[1] = V[0]
    ms = mesh_set(V, F)
    conformal_disk(ms, quality="quasi-conformal")
    ratio = ms.current_mesh().face_scalar_array()
    assert np.isfinite(ratio).all() and ratio.max() > 1
    assert np.isinf(cuv.unwrap(V, F).charts[0].distortion.quasi_conformal).any()


def test_every_face_gets_texture_index_0_whatever_it_had(tmp_path, face_of_mask):
    V, F = face_of_mask
    meshlab_filter.write_checker(tmp_path / "checker.png", size=64, squares=8)
    ms = mesh_set(V, F, w_tex_coords_matrix=np.zeros((3 * len(F), 2)))  # the constructor leaves index -1
    assert texture_indices(ms) == {-1.0}
    conformal_disk(ms, texture=tmp_path / "checker.png")
    assert texture_indices(ms) == {0.0}
    assert list(ms.current_mesh().textures()) == ["checker.png"]


@pytest.fixture
def two_textures(tmp_path):
    for name in ("a.png", "b.png", "c.png"):
        meshlab_filter.write_checker(tmp_path / name, size=16, squares=2)
    (tmp_path / "m.mtl").write_text("newmtl A\nmap_Kd a.png\nnewmtl B\nmap_Kd b.png\n")
    V, F = plate(3, 2)
    lines = ["mtllib m.mtl", *("v {} {} {}".format(*v) for v in V), "vt 0 0", "vt 1 0", "vt 0 1"]
    faces = ["f {}/1 {}/2 {}/3".format(*(f + 1)) for f in F]
    (tmp_path / "m.obj").write_text("\n".join([*lines, "usemtl A", *faces[:4], "usemtl B", *faces[4:]]) + "\n")
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(tmp_path / "m.obj"))
    return ms


def test_a_mesh_keeps_its_textures_and_which_face_has_which(two_textures):
    ms = two_textures
    conformal_disk(ms)
    assert sorted(ms.current_mesh().textures()) == ["a.png", "b.png"]
    assert texture_indices(ms) == {0.0, 1.0}
    F = ms.current_mesh().face_matrix()
    uv = cuv.unwrap(ms.current_mesh().vertex_matrix(), F).uv
    np.testing.assert_array_equal(wedges(ms).reshape(-1, 2), uv.astype(np.float32))


def test_a_texture_given_replaces_all_of_them(two_textures, tmp_path):
    """An index beyond the list of textures makes pymeshlab's DAE writer crash."""
    conformal_disk(two_textures, texture=str(tmp_path / "c.png"))
    assert sorted(two_textures.current_mesh().textures()) == ["c.png"]
    assert texture_indices(two_textures) == {0.0}


REFUSALS = [
    ({"method": "magic"}, cuv.OptionError, "method"),
    ({"quality": "beauty"}, cuv.OptionError, "quality"),
    ({"center": 10**6}, cuv.OptionError, "belong to no selected face"),
    ({"center": "middle"}, cuv.OptionError, "vertex indices"),
    ({"seams": [(0, 300)]}, cuv.OptionError, "not edges"),
    ({"margin": 0.7}, cuv.OptionError, "margin"),
    ({"texture": "missing.png"}, cuv.ConformalUVError, "missing.png"),
    ({"callback": lambda stage, fraction: False}, cuv.CancelledError, "nothing was changed"),
]


@pytest.mark.parametrize("options, cause, text", REFUSALS, ids=lambda value: str(value)[:30])
def test_a_refusal_is_a_pymeshlab_exception_and_changes_nothing(face_of_mask, options, cause, text):
    ms = mesh_set(*face_of_mask)
    before = contents(ms)
    with pytest.raises(pymeshlab.PyMeshLabException, match=text) as caught:
        conformal_disk(ms, **options)
    assert isinstance(caught.value, ConformalFilterException)
    assert type(caught.value.__cause__) is cause
    assert str(caught.value.__cause__) in str(caught.value) and NAME in str(caught.value)
    assert changed(before, contents(ms)) == set()


def test_a_file_that_is_no_image_is_refused_before_anything_is_written(face_of_mask, tmp_path):
    (tmp_path / "image.png").write_text("no image")
    ms = mesh_set(*face_of_mask)
    before = contents(ms)
    with pytest.raises(ConformalFilterException, match=r"image\.png"):
        conformal_disk(ms, texture=tmp_path / "image.png")
    assert changed(before, contents(ms)) == set()


def test_indices_of_the_error_are_carried_along():
    V, F = plate(3, 3)
    V[5, 1] = np.nan
    with pytest.raises(ConformalFilterException) as caught:
        conformal_disk(mesh_set(V, F))
    assert caught.value.indices == (5,)
    assert isinstance(caught.value.__cause__, cuv.NonFiniteError)


def test_nothing_selected(face_of_mask):
    ms = mesh_set(*face_of_mask)
    ms.compute_selection_by_condition_per_face(condselect="0")
    with pytest.raises(ConformalFilterException, match="No face is selected"):
        conformal_disk(ms, selected_only=True)


@pytest.mark.parametrize("element", ["vertex", "face"])
def test_an_attribute_name_that_breaks_function_filters_is_found_before_anything_is_written(element, face_of_mask):
    V, F = face_of_mask
    ms = mesh_set(V, F)
    add = getattr(ms.current_mesh(), f"add_{element}_custom_scalar_attribute")
    add(np.zeros(len(V) if element == "vertex" else len(F)), "a.b")
    before = contents(ms)
    with pytest.raises(ConformalFilterException, match="custom attribute"):
        conformal_disk(ms)
    assert changed(before, contents(ms)) == set()


def test_attributes_of_the_users_under_our_names_are_left_alone():
    V, F = plate(3, 3)
    ms = mesh_set(V, F)
    ms.current_mesh().add_vertex_custom_scalar_attribute(np.full(len(V), 7.0), "conformal_uv_u")
    ms.current_mesh().add_vertex_custom_point_attribute(np.full((len(V), 3), 7.0), "conformal_uv_v")
    conformal_disk(ms)
    np.testing.assert_array_equal(wedges(ms).reshape(-1, 2), cuv.unwrap(V, F).uv.astype(np.float32))
    np.testing.assert_array_equal(ms.current_mesh().vertex_custom_scalar_attribute_array("conformal_uv_u"), 7.0)


def test_no_mesh_and_no_faces():
    with pytest.raises(pymeshlab.PyMeshLabException, match="no current"):
        conformal_disk(pymeshlab.MeshSet())
    cloud = pymeshlab.MeshSet()
    cloud.add_mesh(pymeshlab.Mesh(np.eye(3)))
    with pytest.raises(ConformalFilterException, match="no polygons"):
        conformal_disk(cloud)


def test_registered_it_is_a_filter_like_pymeshlabs_own(face_of_mask):
    meshlab_filter.register()
    try:
        meshlab_filter.register()  # again does no harm
        ms = mesh_set(*face_of_mask)
        method = getattr(ms, NAME)
        numbers = method(method="linear")
        assert numbers == conformal_disk(mesh_set(*face_of_mask), method="linear")
        assert method.__name__ == NAME and method.__doc__ == conformal_disk.__doc__
        own, plain = (inspect.signature(f).parameters for f in (getattr(pymeshlab.MeshSet, NAME), conformal_disk))
        assert list(own)[1:] == list(plain)[1:] and own["method"].default == "newton"
        with pytest.raises(TypeError):
            method("linear")  # as pymeshlab's own: keywords only
        with pytest.raises(pymeshlab.PyMeshLabException, match="Parameter colour not found"):
            method(colour=1)
    finally:
        meshlab_filter.unregister()
    assert not hasattr(pymeshlab.MeshSet, NAME)
    meshlab_filter.unregister()


def test_options_and_their_defaults_are_those_of_unwrap():
    ours, core = (inspect.signature(f).parameters for f in (conformal_disk, cuv.unwrap))
    shared = ours.keys() & core.keys()
    assert {name: ours[name].default for name in shared} == {name: core[name].default for name in shared}
    assert ours.keys() - shared == {"ms", "selected_only", "texture", "quality"}
    assert core.keys() - shared == {
        "V", "polygons", "selection", "rotation", "tolerance", "max_iterations", "outer_loop"
    }  # fmt: skip


def test_crowding_that_float32_can_not_hold_is_counted():
    """A ribbon 40 times as long as wide: its ends are smaller in the disk than single precision can tell apart."""
    V, F = strip(40)
    numbers = conformal_disk(mesh_set(V, F))
    mesh_of = mesh_set(V, F)
    conformal_disk(mesh_of)
    uv = wedges(mesh_of)
    a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    flat = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] <= 0  # float32 differences and products are exact in doubles
    assert numbers["lost_to_float32"] == flat.sum() > 0
    assert conformal_disk(mesh_set(*fan(5)))["lost_to_float32"] == 0


def test_a_hole_is_filled_for_the_solution_only():
    V, F = annulus(12)
    ms = mesh_set(V, F)
    numbers = conformal_disk(ms)
    assert numbers["mapped_faces"] == len(F) == ms.current_mesh().face_number()
    outer = ms.current_mesh().vertex_tex_coord_matrix()[12:] - 0.5
    np.testing.assert_allclose(np.hypot(*outer.T), 0.5, rtol=1e-6)  # on the circle, in float32
