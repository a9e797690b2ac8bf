"""Per-face scalars, texture indices and what single precision loses."""

from __future__ import annotations

import numpy as np
import pytest

try:
    import pymeshlab
except ImportError:
    pytest.skip("pymeshlab is not installed", allow_module_level=True)

from meshes import fan, plate, strip
from meshlab_sets import TEXCOORDS, changed, contents, mesh_set, wedges

import conformal_uv as cuv
import meshlab_filter
from conformal_uv.samples import mask
from meshlab_filter import compute_texcoord_parametrization_conformal_disk as conformal_disk


@pytest.fixture
def face_of_mask():
    return mask(600)


def texture_indices(ms) -> set[float]:
    ms.compute_new_custom_scalar_attribute_per_face(name="texture_index", expr="ti")
    return set(ms.current_mesh().face_custom_scalar_attribute_array("texture_index"))


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


def test_crowding_that_float32_can_not_hold_is_counted():
    """A ribbon 40 times as long as wide: its ends are smaller in the disk than single precision can tell apart."""
    V, F = strip(40)
    mesh_of = mesh_set(V, F)
    numbers = conformal_disk(mesh_of, repair="never")
    uv = wedges(mesh_of)
    a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    flat = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] <= 0  # float32 differences and products are exact in doubles
    assert numbers["lost_to_float32"] == flat.sum() > 0
    assert conformal_disk(mesh_set(*fan(5)))["lost_to_float32"] == 0


def test_faces_that_are_not_mapped_keep_their_quality():
    V, F = plate(6, 6)
    ms = mesh_set(V, F)
    old = ms.current_mesh().face_scalar_array().copy()
    ms.compute_selection_by_condition_per_face(condselect="x0 + x1 + x2 < 8")
    selected = ms.current_mesh().face_selection_array()
    conformal_disk(ms, selected_only=True, quality="angle", method="linear")
    now = ms.current_mesh().face_scalar_array()
    assert old[~selected].any()
    np.testing.assert_array_equal(now[~selected], old[~selected])
    (chart,) = cuv.unwrap(V, F, selection=selected, method="linear").charts
    np.testing.assert_allclose(now[chart.polygon], chart.distortion.angle_error.mean(axis=1), rtol=1e-5, atol=1e-6)
