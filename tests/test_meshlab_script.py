"""``python -m meshlab_filter`` as a user runs it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from importlib.metadata import entry_points
from pathlib import Path

import numpy as np
import pytest

try:
    import pymeshlab
except ImportError:
    pytest.skip("pymeshlab is not installed", allow_module_level=True)

from meshes import disjoint, plate, tetrahedron
from meshlab_sets import loaded

import conformal_uv as cuv
from conformal_uv.console.stages import Stages
from conformal_uv.samples import mask
from meshlab_filter.conversion import Conversion, convert


def run(*arguments: object, code: int = 0) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "meshlab_filter", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == code, done.stdout + done.stderr
    assert "Traceback" not in done.stderr
    return done


def saved(path: Path, V: np.ndarray, F: np.ndarray) -> Path:
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(V, F))
    ms.save_current_mesh(str(path))
    return path


@pytest.fixture(scope="module")
def surface(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return saved(tmp_path_factory.mktemp("surface") / "mask.ply", *mask(500))


def test_checker_quality_and_json(surface: Path, tmp_path: Path):
    done = run(
        surface, tmp_path / "out.ply", "--texture", "checker", "--quality", "angle", "--json", tmp_path / "n.json"
    )
    V, F = mask(500)
    expected = cuv.unwrap(V, F)
    mesh = loaded(tmp_path / "out.ply")
    np.testing.assert_array_equal(mesh.vertex_matrix(), V)
    np.testing.assert_array_equal(mesh.wedge_tex_coord_matrix(), expected.uv.astype(np.float32))
    quality = expected.charts[0].distortion.angle_error.mean(axis=1)
    np.testing.assert_array_equal(mesh.face_scalar_array(), quality)
    assert list(mesh.textures()) == ["out_checker.png"]
    assert sorted(file.name for file in tmp_path.iterdir()) == ["n.json", "out.ply", "out_checker.png"]
    numbers = json.loads((tmp_path / "n.json").read_text())
    assert numbers["conformal_energy"] == expected.charts[0].map.conformal_energy
    assert numbers["filter"]["mapped_faces"] == len(F)
    for word in ("500 vertices", "newton", "angle error"):
        assert word in done.stdout


def test_numbers_on_standard_output_stand_alone(surface: Path, tmp_path: Path):
    told = run(surface, tmp_path / "out.obj", "--json", "-").stdout
    assert json.loads(told)["filter"]["mapped_faces"] == len(mask(500)[1])


def test_outputs_that_would_overwrite_each_other_or_the_input(surface: Path, tmp_path: Path):
    source = tmp_path / "in.obj"
    source.write_bytes(saved(tmp_path / "mask.obj", *mask(200)).read_bytes())
    before = source.read_bytes()
    assert "--json is the input" in run(source, tmp_path / "out.obj", "--json", source, code=1).stderr
    assert "both" in run(source, tmp_path / "out.obj", "--json", tmp_path / "out.obj", code=1).stderr
    assert "nowhere" in run(source, tmp_path / "out.obj", "--json", tmp_path / "nowhere" / "n.json", code=1).stderr
    assert source.read_bytes() == before and not (tmp_path / "out.obj").exists()


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with names here")
def test_pipes_are_not_replaced_and_links_are_followed(surface: Path, tmp_path: Path):
    os.mkfifo(tmp_path / "pipe.obj")
    assert "devices or pipes" in run(surface, tmp_path / "pipe.obj", code=1).stderr
    assert (tmp_path / "pipe.obj").is_fifo()
    real, link = tmp_path / "real.ply", tmp_path / "link.ply"
    real.write_text("")
    real.chmod(0o640)
    link.symlink_to(real)
    run(surface, link)
    assert link.is_symlink() and loaded(real).face_number() == len(mask(500)[1])
    assert real.stat().st_mode & 0o777 == 0o640


def test_formats_that_lose_uvs_are_refused_by_name_before_any_work(tmp_path: Path):
    """The input does not even exist."""
    for name in ("out.stl", "out.glb", "out.x3d", "out.3mf"):
        done = run(tmp_path / "absent.obj", tmp_path / name, code=1)
        assert name in done.stderr and ".obj, .ply, .dae, .off" in done.stderr
    done = run(tmp_path / "absent.obj", tmp_path, "--format", "stl", code=1)
    assert ".stl" in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_dae_asks_for_a_texture(surface: Path, tmp_path: Path):
    assert "--texture checker" in run(surface, tmp_path / "out.dae", code=1).stderr
    assert list(tmp_path.iterdir()) == []
    run(surface, tmp_path / "out.dae", "--texture", "checker")
    np.testing.assert_allclose(
        loaded(tmp_path / "out.dae").wedge_tex_coord_matrix(), cuv.unwrap(*mask(500)).uv, atol=1e-6
    )


def test_off_comes_with_a_warning(surface: Path, tmp_path: Path):
    done = run(surface, tmp_path / "out.off")
    assert "does not read" in done.stderr and "STOFF" in (tmp_path / "out.off").read_text()[:20]


def test_dae_without_texture_is_refused_before_the_map(tmp_path: Path):
    """The mesh could not be mapped either; that is not what is told."""
    closed = saved(tmp_path / "closed.ply", *tetrahedron())
    assert "FileFormatError" in run(closed, tmp_path / "out.dae", code=1).stderr


def test_many_inputs_one_line_each_failures_at_the_end(surface: Path, tmp_path: Path):
    inputs = tmp_path / "in"
    inputs.mkdir()
    closed = saved(inputs / "closed.off", *tetrahedron())
    flat = saved(inputs / "flat.stl", *plate(4, 3))
    broken = inputs / "broken.ply"
    broken.write_text("no mesh")
    out = tmp_path / "out"
    out.mkdir()
    done = run(closed, surface, broken, flat, out, "--json", tmp_path / "n.json", code=1)
    lines = done.stdout.splitlines()
    assert [line.split(" ")[0].removesuffix(":") for line in lines] == list(map(str, (closed, surface, broken, flat)))
    assert "angle error" in lines[1] and lines[0].endswith("failed")
    failures = done.stderr.splitlines()
    assert len(failures) == 2
    assert failures[0].startswith(f"{closed}: TopologyError: ") and failures[1].startswith(f"{broken}: ")
    assert sorted(file.name for file in out.iterdir()) == ["flat.obj", "flat.obj.mtl", "mask.ply"]
    told = json.loads((tmp_path / "n.json").read_text())
    assert ["error" in one for one in told] == [True, False, True, False]


def test_format_of_a_folder_and_names_that_clash(surface: Path, tmp_path: Path):
    run(surface, tmp_path, "--format", "obj", "-q")
    assert loaded(tmp_path / "mask.obj").has_wedge_tex_coord()
    other = saved(tmp_path / "mask.stl", *plate(3, 3))
    done = run(surface, other, tmp_path, "--format", "ply", code=1)
    assert "would both become" in done.stderr
    assert "existing folder" in run(surface, other, tmp_path / "out.ply", code=1).stderr


def test_a_part_that_fails_is_told_and_the_rest_is_written(tmp_path: Path):
    both = saved(tmp_path / "both.ply", *disjoint(plate(4, 3), tetrahedron()))
    done = run(both, tmp_path / "out.ply", code=1)
    assert "mapped 1 of 2 charts" in done.stderr and done.stderr.count("mapped 1 of 2") == 1
    assert loaded(tmp_path / "out.ply").wedge_tex_coord_matrix()[:72].any()


def test_quiet_says_nothing(surface: Path, tmp_path: Path):
    done = run(surface, tmp_path / "out.obj", "-q", "--method", "linear")
    assert done.stdout == done.stderr == ""
    expected = cuv.unwrap(*mask(500), method="linear").uv.astype(np.float32)
    np.testing.assert_array_equal(loaded(tmp_path / "out.obj").wedge_tex_coord_matrix(), expected)


def test_filter_script_runs_before_the_map(surface: Path, tmp_path: Path):
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(surface))
    ms.meshing_decimation_quadric_edge_collapse(targetfacenum=300, preserveboundary=True, preservetopology=True)
    ms.save_filter_script(str(tmp_path / "decimate.mlx"))
    run(surface, tmp_path / "out.ply", "--script", tmp_path / "decimate.mlx", "-q")
    mesh = loaded(tmp_path / "out.ply")
    assert mesh.face_number() == ms.current_mesh().face_number() <= 300
    expected = cuv.unwrap(ms.current_mesh().vertex_matrix(), ms.current_mesh().face_matrix()).uv
    np.testing.assert_array_equal(mesh.wedge_tex_coord_matrix(), expected.astype(np.float32))


@pytest.mark.parametrize("text", [None, "no xml", "<!DOCTYPE FilterScript><FilterScript/>", "<other><a/></other>"])
def test_what_is_no_filter_script_is_refused(text: str | None, surface: Path, tmp_path: Path):
    if text is not None:
        (tmp_path / "bad.mlx").write_text(text)
    done = run(surface, tmp_path / "out.ply", "--script", tmp_path / "bad.mlx", code=1)
    assert "bad.mlx" in done.stderr and not (tmp_path / "out.ply").exists()


def test_texture_file_is_linked_and_a_bad_one_refused(surface: Path, tmp_path: Path):
    from PIL import Image

    Image.new("RGB", (4, 4), (255, 0, 0)).save(tmp_path / "red.png")
    (tmp_path / "out").mkdir()
    run(surface, tmp_path / "out" / "mesh.obj", "--texture", tmp_path / "red.png", "-q")
    assert list(loaded(tmp_path / "out" / "mesh.obj").textures()) == ["red.png"]
    before = (tmp_path / "red.png").read_bytes()
    run(surface, tmp_path / "mesh.obj", "--texture", tmp_path / "red.png", "-q")
    assert (tmp_path / "red.png").read_bytes() == before
    (tmp_path / "out" / "red.png").write_bytes(b"an older one")
    run(surface, tmp_path / "out" / "mesh.obj", "--texture", tmp_path / "red.png", "-q")
    assert (tmp_path / "out" / "red.png").read_bytes() != b"an older one"
    done = run(surface, tmp_path / "other.obj", "--texture", tmp_path / "absent.png", code=1)
    assert "absent.png" in done.stderr and not (tmp_path / "other.obj").exists()


def test_wrong_usage_exits_with_2(surface: Path, tmp_path: Path):
    run(surface, code=2)
    run(surface, tmp_path / "out.ply", "--method", "magic", code=2)


def test_console_script_is_declared():
    (script,) = entry_points(group="console_scripts", name="conformal-uv-meshlab")
    from meshlab_filter.entry import main

    assert script.load() is main


def python(code: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)


def test_without_pymeshlab_it_says_what_to_install():
    done = python("import sys; sys.modules['pymeshlab'] = None; from meshlab_filter.entry import main; main()")
    assert done.returncode == 1 and 'pip install "conformal-uv[meshlab]"' in done.stderr
    done = python("import sys; sys.modules['pymeshlab'] = None; import meshlab_filter; meshlab_filter.register()")
    assert "MissingDependencyError" in done.stderr and "conformal-uv[meshlab]" in done.stderr


def test_never_in_one_process_with_bpy():
    code = "import sys, types; sys.modules['bpy'] = types.ModuleType('bpy'); import meshlab_filter; "
    done = python(code + "print('imported'); meshlab_filter.register()")
    assert done.stdout == "imported\n" and "bpy can not share a process" in done.stderr
    assert "pymeshlab" not in python(code + "print([m for m in sys.modules if 'pymeshlab' in m])").stdout


def test_the_layers_of_a_file_become_charts_of_one_mesh(tmp_path: Path) -> None:
    """pymeshlab loads each mesh of a GLB as a layer of its own."""
    trimesh = pytest.importorskip("trimesh")
    parts = [trimesh.Trimesh(*plate(3, 3)), trimesh.Trimesh(*plate(4, 2)).apply_translation([9, 0, 0])]
    trimesh.Scene(parts).export(tmp_path / "two.glb")
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(str(tmp_path / "two.glb"))
    assert ms.mesh_number() == 2
    told = convert(tmp_path / "two.glb", tmp_path / "one.obj", Conversion(), Stages(quiet=True))
    assert told["mesh"]["triangles"] == 2 * (9 + 8) and len(told["charts"]) == 2
    assert loaded(tmp_path / "one.obj").face_number() == 2 * (9 + 8)
