"""Saved and loaded again: coordinates, texture, positions, colours."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

try:
    import pymeshlab
except ImportError:
    pytest.skip("pymeshlab is not installed", allow_module_level=True)

from meshes import octahedron, plate
from meshlab_sets import loaded, mesh_set
from polygon_shapes import grid

from conformal_uv import FileFormatError
from conformal_uv.samples import mask
from meshlab_filter import (
    ConformalFilterException,
    compute_texcoord_parametrization_conformal_disk,
    save_textured_mesh,
    write_checker,
)

# How far a saved number may be from the one in memory: MeshLab writes 16 decimals to OBJ, 6 digits to DAE and OFF.
ROUNDING = {".ply": 0.0, ".obj": 6e-17, ".dae": 5e-7, ".off": 5e-7}


@pytest.fixture
def textured(tmp_path: Path):
    V, F = mask(400)
    ms = mesh_set(V, F)
    (tmp_path / "images").mkdir()
    write_checker(tmp_path / "images" / "checker.png", size=64, squares=8)
    compute_texcoord_parametrization_conformal_disk(ms, texture=tmp_path / "images" / "checker.png", quality="angle")
    return ms


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".dae"])
def test_round_trip(suffix: str, textured, tmp_path: Path):
    path = tmp_path / f"mesh{suffix}"
    save_textured_mesh(textured, path)
    mesh, again = textured.current_mesh(), loaded(path)
    np.testing.assert_array_equal(again.face_matrix(), mesh.face_matrix())
    positions = mesh.vertex_matrix()
    np.testing.assert_allclose(again.vertex_matrix(), positions, rtol=0, atol=ROUNDING[suffix])
    uv = mesh.wedge_tex_coord_matrix()
    # Of the digits of OBJ and PLY exactly the same single precision numbers come back.
    np.testing.assert_allclose(again.wedge_tex_coord_matrix(), uv, rtol=0, atol=1e-6 if suffix == ".dae" else 0.0)
    assert list(again.textures()) == ["checker.png"]
    assert (tmp_path / "checker.png").read_bytes().startswith(b"\x89PNG")
    assert not [file for file in tmp_path.iterdir() if file.name.startswith(".")]


def test_obj_and_ply_name_their_texture(textured, tmp_path: Path):
    save_textured_mesh(textured, tmp_path / "mesh.obj")
    save_textured_mesh(textured, tmp_path / "mesh.ply")
    assert "map_Kd checker.png" in (tmp_path / "mesh.obj.mtl").read_text()
    assert b"comment TextureFile checker.png" in (tmp_path / "mesh.ply").read_bytes()[:300]


def test_ply_keeps_colours_and_quality_and_no_attributes_of_ours(textured, tmp_path: Path):
    save_textured_mesh(textured, tmp_path / "mesh.ply")
    mesh, again = textured.current_mesh(), loaded(tmp_path / "mesh.ply")
    np.testing.assert_array_equal(again.vertex_color_matrix(), mesh.vertex_color_matrix())
    np.testing.assert_array_equal(again.face_scalar_array(), mesh.face_scalar_array())
    assert b"conformal_uv" not in (tmp_path / "mesh.ply").read_bytes()[:1000]


def test_off_keeps_the_vertex_coordinates(textured, tmp_path: Path):
    """Last in each vertex's line. pymeshlab's own reader takes random numbers instead, with or without our filter."""
    save_textured_mesh(textured, tmp_path / "mesh.off")
    header, counts, *lines = (tmp_path / "mesh.off").read_text().splitlines()
    assert "ST" in header
    uv = np.array([line.split()[-2:] for line in lines[: int(counts.split()[0])]], dtype=float)
    np.testing.assert_allclose(uv, textured.current_mesh().vertex_tex_coord_matrix(), atol=1e-6)


def test_quads_go_into_obj_as_triangles_with_the_right_coordinates(tmp_path: Path):
    V, Q = grid(4, 3)
    text = "".join("v {} {} {}\n".format(*v) for v in V) + "".join("f {} {} {} {}\n".format(*(q + 1)) for q in Q)
    (tmp_path / "quads.obj").write_text(text)
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(tmp_path / "quads.obj"))
    compute_texcoord_parametrization_conformal_disk(ms)
    for suffix in (".obj", ".ply"):
        save_textured_mesh(ms, tmp_path / f"out{suffix}")
        again = loaded(tmp_path / f"out{suffix}")
        uv = again.wedge_tex_coord_matrix().reshape(-1, 3, 2)
        expected = ms.current_mesh().vertex_tex_coord_matrix()[again.face_matrix()]
        # MeshLab writes OBJ with 16 decimals, of numbers that are float32 in it: only what is nearly 0 loses digits.
        np.testing.assert_allclose(uv, expected, rtol=0, atol=5.1e-17 if suffix == ".obj" else 0)
        assert np.ptp(uv[..., 0]) == pytest.approx(1.0, abs=0.1)


def test_what_a_format_would_lose_is_refused(tmp_path: Path, textured):
    ms = mesh_set(*octahedron())
    compute_texcoord_parametrization_conformal_disk(ms, closed="cut")
    refusals = [(ms, "m.stl", r"m\.stl.*\.stl"), (ms, "m.glb", r"\.glb"), (ms, "m.x3d", r"\.x3d"), (ms, "m", "suffix")]
    refusals += [(ms, "m.off", "one texture coordinate a vertex"), (ms, "m.dae", "only for meshes with a texture")]
    refusals += [(ms, "absent/m.obj", "does not exist")]
    for meshes, name, text in refusals:
        with pytest.raises(ConformalFilterException, match=text) as caught:
            save_textured_mesh(meshes, tmp_path / name)
        assert isinstance(caught.value.__cause__, FileFormatError)
    assert not [file for file in tmp_path.iterdir() if file.name != "images"]


def test_a_failure_leaves_the_file_that_was_there(textured, tmp_path: Path):
    (tmp_path / "mesh.obj").write_text("precious")

    class Failing:
        """A MeshSet whose writer stops half way."""

        current_mesh = textured.current_mesh

        @staticmethod
        def save_current_mesh(name: str, **options: object) -> None:
            Path(name).write_text("half a me")
            raise pymeshlab.PyMeshLabException("disk full")

    with pytest.raises(pymeshlab.PyMeshLabException, match="disk full"):
        save_textured_mesh(Failing(), tmp_path / "mesh.obj")
    assert (tmp_path / "mesh.obj").read_text() == "precious"
    assert sorted(file.name for file in tmp_path.iterdir()) == ["images", "mesh.obj"]


@pytest.mark.parametrize("keep", [True, False])
def test_an_image_that_is_there_already_can_be_kept(keep: bool, textured, tmp_path: Path):
    (tmp_path / "checker.png").write_bytes(b"mine")
    save_textured_mesh(textured, tmp_path / "mesh.obj", keep_images=keep)
    assert ((tmp_path / "checker.png").read_bytes() == b"mine") is keep


def test_checker_is_a_checker(tmp_path: Path):
    from PIL import Image

    write_checker(tmp_path / "checker.png", size=64, squares=8)
    with Image.open(tmp_path / "checker.png") as image:
        pixels = np.asarray(image).astype(int)
    assert pixels.shape == (64, 64, 3)
    bright = pixels.sum(axis=2)[4::8, 4::8]  # the middles of the squares
    row, column = np.indices(bright.shape)
    assert bright[(row + column) % 2 == 0].min() > 1.5 * bright[(row + column) % 2 == 1].max()


@pytest.mark.parametrize("keep", [False, True])
def test_the_mesh_itself_is_replaced_whether_images_are_kept_or_not(keep, tmp_path):
    for columns in (2, 5):
        ms = mesh_set(*plate(columns, 3))
        compute_texcoord_parametrization_conformal_disk(ms, method="linear")
        save_textured_mesh(ms, tmp_path / "a.obj", keep_images=keep)
    assert loaded(tmp_path / "a.obj").face_number() == 2 * 5 * 3
