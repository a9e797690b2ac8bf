"""The conformal-uv command, run as a user runs it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from meshes_closed import icosphere

import conformal_uv as cuv
from conformal_uv.files import read_mesh
from conformal_uv.samples import mask


def run(*arguments: object, check: int = 0) -> subprocess.CompletedProcess[str]:
    """Run the command in a process of its own and compare its exit code."""
    command = [sys.executable, "-c", "from conformal_uv.cli.entry import main; main()", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == check, done.stderr
    assert "Traceback" not in done.stderr
    return done


@pytest.fixture(scope="module")
def surface(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("cli") / "mask.obj"
    run("sample", "mask", path, "--vertices", 1500)
    return path


def test_sample_is_the_surface_of_the_samples_module(surface: Path):
    V, F = mask(1500)
    mesh = read_mesh(surface).mesh
    np.testing.assert_array_equal(mesh.V, V)
    np.testing.assert_array_equal(mesh.corners.reshape(-1, 3), F)


def test_disk_writes_the_map_of_the_library_into_the_unit_square(surface: Path, tmp_path: Path):
    done = run("disk", surface, tmp_path / "out.obj", "--json", tmp_path / "out.json", "--upright", "none")
    V, F = mask(1500)
    expected = cuv.disk_map(V, F)
    written = read_mesh(tmp_path / "out.obj")
    # The text has enough digits to give back the same doubles.
    np.testing.assert_array_equal(written.corner_uv.reshape(-1, 3, 2), (0.5 + 0.5 * expected.uv)[F])
    numbers = json.loads((tmp_path / "out.json").read_text())
    assert numbers["conformal_energy"] == expected.conformal_energy
    assert numbers["mesh"] == {
        "vertices": 1500,
        "triangles": len(F),
        "faces": len(F),
        "mapped_faces": len(F),
        "boundary_vertices": len(expected.boundary),
    }
    # The same numbers summed in another order.
    assert numbers["angle_error_degrees"]["mean"] == pytest.approx(expected.distortion.angle_mean, rel=1e-13)
    assert numbers["flipped_faces"] == 0 and numbers["converged"] is True
    assert {"read", "checks", "assembly", "factorization", "newton", "distortion", "write"} <= set(numbers["seconds"])
    for word in ("1500 vertices", "newton", "conformal energy", "angle error", "flipped faces", "seconds"):
        assert word in done.stdout


def test_disk_keeps_every_line_of_an_obj_but_those_of_texture(tmp_path: Path):
    V, F = mask(400)
    lines = ["# a comment", "mtllib paint.mtl", "o Mask"]
    lines += ["v {:.17g} {:.17g} {:.17g}".format(*v) for v in V]
    lines += ["g left", "usemtl skin", "s 1"]
    half = len(F) // 2
    faces = ["f {} {} {}".format(*(f + 1)) for f in F]
    source = tmp_path / "in.obj"
    source.write_text("\n".join([*lines, *faces[:half], "g right", *faces[half:]]) + "\n")
    run("disk", source, tmp_path / "out.obj", "--method", "linear", "-q")
    after = [line for line in (tmp_path / "out.obj").read_text().splitlines() if not line.startswith("vt ")]
    bare = [
        "f " + " ".join(c.split("/")[0] for c in line.split()[1:]) if line.startswith("f ") else line for line in after
    ]
    assert bare == source.read_text().splitlines()
    assert all(c.count("/") == 1 for line in after if line.startswith("f ") for c in line.split()[1:])


def test_quiet_says_nothing_and_output_may_replace_the_input(tmp_path: Path):
    path = tmp_path / "mesh.ply"
    run("sample", "terrain", path, "--vertices", 400)
    done = run("disk", path, path, "-q")
    assert done.stdout == "" and done.stderr == ""
    assert np.isfinite(read_mesh(path).corner_uv).all()


def test_quads_stay_quads(tmp_path: Path):
    side = 6
    grid = np.arange(side * side).reshape(side, side)
    quads = np.stack((grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]), axis=-1).reshape(-1, 4)
    text = "".join(f"v {i % side} {i // side} {0.1 * (i % 5)}\n" for i in range(side * side))
    text += "".join("f {} {} {} {}\n".format(*(quad + 1)) for quad in quads)
    (tmp_path / "quads.obj").write_text(text)
    run("disk", tmp_path / "quads.obj", tmp_path / "out.obj", "-q")
    mesh = read_mesh(tmp_path / "out.obj").mesh
    np.testing.assert_array_equal(mesh.corners.reshape(-1, 4), quads)


def test_pins_come_to_the_cube_roots_of_unity(surface: Path, tmp_path: Path):
    V, F = mask(1500)
    loop = cuv.DiskMapper(V, F).boundary
    pins = [int(v) for v in loop[[3, 40, 90]]]
    run("disk", surface, tmp_path / "out.npz", "--pins", ",".join(map(str, pins)), "-q")
    uv = np.load(tmp_path / "out.npz")["uv"]
    angle = 2 * np.pi / 3 * np.arange(3)
    # Four roundings of numbers of size 1.
    np.testing.assert_allclose(uv[pins], 0.5 + 0.5 * np.column_stack((np.cos(angle), np.sin(angle))), atol=1e-15)


@pytest.mark.parametrize("suffix", ["png", "pdf", "svg"])
def test_plot_draws_a_file_of_the_kind_named(surface: Path, tmp_path: Path, suffix: str):
    picture = tmp_path / f"picture.{suffix}"
    run("disk", surface, tmp_path / "out.ply", "--plot", picture, "-q")
    start = {"png": b"\x89PNG", "pdf": b"%PDF", "svg": b"<?xml"}[suffix]
    assert picture.read_bytes().startswith(start)


def test_report_tells_what_a_mesh_is(surface: Path, tmp_path: Path):
    run("disk", surface, tmp_path / "out.obj", "-q")
    done = run("report", tmp_path / "out.obj", "--json", tmp_path / "report.json")
    told = json.loads((tmp_path / "report.json").read_text())
    V, F = mask(1500)
    expected = cuv.disk_map(V, F)
    assert told["topology"] == "disk" and told["genus"] == 0 and told["pieces"] == 1
    assert [loop["vertices"] for loop in told["boundary_loops"]] == [len(expected.boundary)]
    # UVs are the disk halved: angles do not change but by the rounding of 0.5 + 0.5 uv, 1e-16 over edges of 1e-2.
    assert told["uv"]["angle_error_degrees"]["mean"] == pytest.approx(expected.distortion.angle_mean, abs=1e-10)
    area = cuv.face_areas(V, F).sum()
    assert told["area"] == pytest.approx(area, rel=1e-12)
    assert "disk" in done.stdout


def test_report_names_the_problem_of_a_mesh_that_is_no_surface(tmp_path: Path):
    path = tmp_path / "fin.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n")
    assert "NonManifoldError" in run("report", path).stdout


@pytest.mark.parametrize(
    ("arguments", "code", "words"),
    [
        (["disk", "missing.obj", "out.obj"], 1, "FileFormatError"),
        (["disk", "MASK", "out.stl"], 1, "FileFormatError"),
        (["disk", "MASK", "out.obj", "--center", "999999"], 1, "OptionError"),
        (["disk", "MASK", "out.obj", "--plot", "picture.txt"], 1, "OptionError"),
        (["disk", "MASK", "out.obj", "--pins", "1,2"], 2, "three vertex numbers"),
        (["disk", "MASK", "out.obj", "--method", "magic"], 2, "magic"),
        (["disk", "MASK"], 2, "OUT"),
        (["fly"], 2, "fly"),
    ],
)
def test_errors_take_one_line_and_leave_no_output(
    surface: Path, tmp_path: Path, arguments: list[str], code: int, words: str
):
    here = {"MASK": surface, "out.obj": tmp_path / "out.obj", "out.stl": tmp_path / "out.stl"}
    filled = [here.get(a, tmp_path / a if a.startswith("picture") else a) for a in arguments]
    done = run(*filled, check=code)
    assert words in done.stderr
    if code == 1:
        assert len(done.stderr.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


def test_a_closed_surface_is_refused_and_an_old_output_kept(tmp_path: Path):
    (tmp_path / "tetrahedron.off").write_text(
        "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
    )
    (tmp_path / "out.obj").write_text("old")
    done = run("disk", tmp_path / "tetrahedron.off", tmp_path / "out.obj", check=1)
    assert done.stderr.startswith("TopologyError:") and "genus 0" in done.stderr
    assert (tmp_path / "out.obj").read_text() == "old"


def test_version_is_the_packages():
    assert run("--version").stdout.strip() == f"conformal-uv {cuv.__version__}"


def test_completion_script_names_the_command():
    done = subprocess.run(
        [sys.executable, "-c", "from conformal_uv.cli.entry import main; main()", "--show-completion", "bash"],
        capture_output=True,
        text=True,
        timeout=60,
        # The shell is named; which one this process was started from, if any, does not matter.
        env={**os.environ, "_TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION": "1"},
    )
    assert "complete" in done.stdout


def test_without_its_libraries_the_command_says_what_to_install():
    code = (
        "import importlib.util as u; find = u.find_spec\n"
        "u.find_spec = lambda name, *a: None if name == 'typer' else find(name, *a)\n"
        "from conformal_uv.cli.entry import main; main()"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1 and 'pip install "conformal-uv[cli]"' in done.stderr


def plate(columns: int, rows: int, bend: float = 0.05) -> str:
    """An OBJ of a bent plate of quadrangles."""
    text = "".join(f"v {x} {y} {bend * x * x}\n" for y in range(rows + 1) for x in range(columns + 1))
    for y in range(rows):
        for x in range(columns):
            a = y * (columns + 1) + x + 1
            text += f"f {a} {a + 1} {a + columns + 2} {a + columns + 1}\n"
    return text


def test_several_pieces_become_charts_that_do_not_overlap(tmp_path: Path):
    one = plate(4, 3)
    shifted = "".join(f"v {10 + i} {i % 3} {i * i % 5}\n" for i in range(4))
    (tmp_path / "two.obj").write_text(one + shifted + "f 21 22 23 24\n")
    done = run("disk", tmp_path / "two.obj", tmp_path / "out.npz", "--json", tmp_path / "out.json")
    assert "mapped 2 of 2 charts" in done.stdout and "chart 1" in done.stdout
    uv = np.load(tmp_path / "out.npz")["corner_uv"]
    assert uv.min() >= 0 and uv.max() <= 1
    turn = np.linspace(0, 2 * np.pi, 720)
    one, two = (uv @ np.array([np.cos(turn), np.sin(turn)]) for uv in (uv[:48], uv[48:]))
    assert (one.max(axis=0) < two.min(axis=0)).any()  # a line runs between two disks
    assert [chart["status"] for chart in json.loads((tmp_path / "out.json").read_text())["charts"]] == ["mapped"] * 2


def test_one_chart_that_fails_is_told_and_the_others_are_written(tmp_path: Path):
    tetrahedron = "v 50 0 0\nv 51 0 0\nv 50 1 0\nv 50 0 1\nf 21 23 22\nf 21 22 24\nf 22 23 24\nf 21 24 23\n"
    (tmp_path / "mixed.obj").write_text(plate(4, 3) + tetrahedron)
    done = run("disk", tmp_path / "mixed.obj", tmp_path / "out.obj", check=1)
    assert done.stderr.startswith("mapped 1 of 2 charts; chart 1 (faces 12, 13, 14, 15):")
    written = read_mesh(tmp_path / "out.obj").corner_uv
    assert np.isfinite(written[:48]).all() and np.isnan(written[48:]).all()


def test_holes_are_filled_or_refused(tmp_path: Path):
    lines = plate(5, 5).splitlines()
    faces = [k for k, line in enumerate(lines) if line.startswith("f")]
    del lines[faces[12]]  # the middle one
    (tmp_path / "holed.obj").write_text("\n".join(lines))
    run("disk", tmp_path / "holed.obj", tmp_path / "out.obj", "-q")
    assert np.isfinite(read_mesh(tmp_path / "out.obj").corner_uv).all()
    done = run("disk", tmp_path / "holed.obj", tmp_path / "no.obj", "--holes", "refuse", check=1)
    assert done.stderr.startswith("TopologyError:") and not (tmp_path / "no.obj").exists()


def test_a_closed_surface_is_cut_on_request(tmp_path: Path):
    (tmp_path / "cube.obj").write_text(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
        "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
    )
    assert run("disk", tmp_path / "cube.obj", tmp_path / "out.obj", check=1).stderr.startswith("TopologyError:")
    run("disk", tmp_path / "cube.obj", tmp_path / "out.obj", "--closed", "cut", "-q")
    assert np.isfinite(read_mesh(tmp_path / "out.obj").corner_uv).all()


def test_seams_from_a_file_and_from_torn_uvs(tmp_path: Path):
    (tmp_path / "plate.obj").write_text(plate(4, 2))
    (tmp_path / "seams.txt").write_text("# across the middle\n2 7\n7 12\n")
    run("disk", tmp_path / "plate.obj", tmp_path / "cut.obj", "--seams", tmp_path / "seams.txt", "--json",
        tmp_path / "a.json", "-q")  # fmt: skip
    assert len(json.loads((tmp_path / "a.json").read_text())["charts"]) == 2
    # The result is torn along the seam; its UVs are no seams unless asked for.
    run("disk", tmp_path / "cut.obj", tmp_path / "whole.obj", "--json", tmp_path / "b.json", "-q")
    assert len(json.loads((tmp_path / "b.json").read_text())["charts"]) == 1
    run("disk", tmp_path / "cut.obj", tmp_path / "again.obj", "--seams", "uv", "--json", tmp_path / "c.json", "-q")
    assert len(json.loads((tmp_path / "c.json").read_text())["charts"]) == 2
    (tmp_path / "seams.txt").write_text("2 x\n")
    done = run("disk", tmp_path / "plate.obj", tmp_path / "no.obj", "--seams", tmp_path / "seams.txt", check=1)
    assert done.stderr.startswith("FileFormatError:")


def test_crowding_is_warned_of(tmp_path: Path):
    """A ribbon fifty times as long as wide: harmonic measure falls by exp(-pi) a width, below doubles at the ends."""
    (tmp_path / "ribbon.obj").write_text(plate(100, 2, bend=0.0))
    done = run("disk", tmp_path / "ribbon.obj", tmp_path / "out.obj", "--method", "linear", "--repair", "never")
    told = " ".join(done.stdout.split())  # lines are folded to the terminal
    assert "crowded" in told and "single precision" in told


def sphere_file(path: Path) -> Path:
    V, F = icosphere(2)
    text = "".join("v {:.17g} {:.17g} {:.17g}\n".format(*v) for v in V * [1.0, 1.2, 1.6])
    path.write_text(text + "v 9 9 9\n" + "".join("f {} {} {}\n".format(*(f + 1)) for f in F))
    return path


def test_sphere_writes_positions_numbers_and_a_picture(tmp_path: Path):
    """A vertex in no face does not matter and stays where it is."""
    source = sphere_file(tmp_path / "egg.obj")
    done = run("sphere", source, tmp_path / "out.obj", "--json", tmp_path / "out.json", "--plot", tmp_path / "p.png")
    V, F = icosphere(2)
    expected = cuv.sphere_map(V * [1.0, 1.2, 1.6], F)
    written = read_mesh(tmp_path / "out.obj")
    np.testing.assert_array_equal(written.mesh.V[:-1], expected.xyz)
    np.testing.assert_array_equal(written.mesh.V[-1], [9, 9, 9])
    np.testing.assert_array_equal(written.mesh.corners.reshape(-1, 3), F)
    numbers = json.loads((tmp_path / "out.json").read_text())
    assert numbers["conformal_energy"] == expected.conformal_energy and numbers["flipped_faces"] == 0
    assert numbers["signed_volume"] == expected.signed_volume
    assert (tmp_path / "p.png").read_bytes().startswith(b"\x89PNG")
    assert "angle error" in done.stdout


@pytest.mark.parametrize("layout", ["equirectangular", "octahedral"])
def test_sphere_layout_has_a_proper_seam(tmp_path: Path, layout: str):
    """No triangle is torn: all have positive area, and together they fill the square but for what poles lose."""
    source = sphere_file(tmp_path / "egg.obj")
    run("sphere", source, tmp_path / "out.npz", "--uv", layout, "-q")
    uv = np.load(tmp_path / "out.npz")["corner_uv"].reshape(-1, 3, 2)
    a, b, c = uv.transpose(1, 0, 2)
    area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    around_poles = 2 if layout == "equirectangular" else 0  # a face with a pole inside has all longitudes
    assert (area <= 0).sum() <= around_poles
    assert np.abs(area).max() < 0.1  # a torn triangle would span half the square
    assert 0.8 < area.sum() < 1.05


def test_sphere_refuses_a_disk(surface: Path, tmp_path: Path):
    done = run("sphere", surface, tmp_path / "out.obj", check=1)
    assert done.stderr.startswith("TopologyError:") and "disk_map" in done.stderr
    assert list(tmp_path.iterdir()) == []
