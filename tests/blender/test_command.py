"""`blender --command conformal_uv`: the function behind it, and the batch example."""

from __future__ import annotations

import json
import runpy
import sys

import bpy
import numpy as np
import pytest
import scenes
from conftest import REPOSITORY


@pytest.fixture
def blend(tmp_path):
    """A file with a good and a closed mesh, saved in Edit Mode with nothing selected."""
    scenes.primitive("cube")
    scenes.grid()
    scenes.edit()
    bpy.ops.mesh.select_all(action="DESELECT")
    path = tmp_path / "in.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def run(addon, *arguments):
    return addon.command.run([str(argument) for argument in arguments])


def test_one_object(addon, blend, tmp_path):
    out, report = tmp_path / "out.blend", tmp_path / "report.json"
    given = blend.read_bytes()
    assert run(addon, blend, "-o", out, "--object", "Grid", "--method", "linear", "--json", report) == 0
    assert blend.read_bytes() == given
    bpy.ops.wm.open_mainfile(filepath=str(out))
    import conformal_uv as cuv

    grid = bpy.data.objects["Grid"]
    expected = cuv.unwrap(*scenes.arrays(grid), method="linear", place="disk").uv
    np.testing.assert_allclose(scenes.uvs(grid), 0.5 + 0.5 * expected, atol=3e-7)
    told = json.loads(report.read_text())
    assert told["summary"] == "Unwrapped 1 of 1 island"
    assert told["objects"][0]["name"] == "Grid" and told["objects"][0]["angle_mean"] > 0


def test_shapes(addon, blend, tmp_path):
    out, report = tmp_path / "out.blend", tmp_path / "report.json"
    free = ("--shape", "free", "--refine", "--upright", "none")
    for options, asked in (
        (free, {"shape": "free", "refine": True, "upright": "none"}),
        (("--shape", "rectangle", "--corner-choice", "area"), {"shape": "rectangle", "corner_choice": "area"}),
    ):
        assert run(addon, blend, "-o", out, "--object", "Grid", "--json", report, *options) == 0
        bpy.ops.wm.open_mainfile(filepath=str(out))
        import conformal_uv as cuv

        grid = bpy.data.objects["Grid"]
        expected = cuv.unwrap(*scenes.arrays(grid), place="disk", **asked).uv
        np.testing.assert_allclose(scenes.uvs(grid), 0.5 + 0.5 * expected, atol=3e-7)
        assert 0.0 < json.loads(report.read_text())["objects"][0]["coverage"] <= 1.0


def test_every_mesh_and_a_failure(addon, blend, tmp_path, capfd):
    out = tmp_path / "out.blend"
    assert run(addon, blend, "-o", out) == 1
    assert "Unwrapped 1 of 2 islands of 2 objects; Cube, faces 0, 1, 2 ...: " in capfd.readouterr().out
    assert out.exists()
    assert run(addon, blend, "-o", out, "--closed", "cut", "--place", "pack") == 0


def test_nothing_done_writes_nothing(addon, blend, tmp_path):
    assert run(addon, blend, "-o", tmp_path / "out.blend", "--object", "Cube") == 1
    assert not (tmp_path / "out.blend").exists()


def test_wrong_usage(addon, blend, tmp_path, capfd):
    out = tmp_path / "out.blend"
    assert run(addon, blend) == 2
    assert run(addon, blend, "-o", out, "--method", "magic") == 2
    assert run(addon, "--help") == 0
    capfd.readouterr()
    assert run(addon, blend, "-o", out, "--object", "Nobody") == 1
    assert "no mesh object named Nobody" in capfd.readouterr().err
    assert run(addon, tmp_path / "missing.blend", "-o", out) == 1
    assert "missing.blend" in capfd.readouterr().err
    (tmp_path / "text.blend").write_text("not a file of Blender's")
    assert run(addon, tmp_path / "text.blend", "-o", out) == 1
    assert not out.exists()


def test_batch_example(addon, blend, tmp_path, monkeypatch, capsys):
    other = tmp_path / "other.blend"
    other.write_bytes(blend.read_bytes())
    folder = tmp_path / "unwrapped"
    monkeypatch.setattr(sys, "argv", ["python", str(blend), str(other), "--folder", str(folder), "--closed", "CUT"])
    with pytest.raises(SystemExit) as stop:
        runpy.run_path(str(REPOSITORY / "examples" / "blender_batch_unwrap.py"), run_name="__main__")
    assert stop.value.code == 0
    for path in (folder / "in.blend", folder / "other.blend"):
        bpy.ops.wm.open_mainfile(filepath=str(path))
        assert np.ptp(scenes.uvs(bpy.data.objects["Grid"]), axis=0) == pytest.approx([1.0, 1.0], abs=0.02)


def test_batch_example_goes_on_after_a_bad_file(addon, blend, tmp_path, monkeypatch, capsys):
    bad, other = tmp_path / "bad.blend", tmp_path / "other.blend"
    bad.write_bytes(b"no file of Blender's")
    other.write_bytes(blend.read_bytes())
    folder = tmp_path / "unwrapped"

    def exit_code(*arguments):
        monkeypatch.setattr(sys, "argv", ["python", *map(str, arguments), "--folder", str(folder)])
        with pytest.raises(SystemExit) as stop:
            runpy.run_path(str(REPOSITORY / "examples" / "blender_batch_unwrap.py"), run_name="__main__")
        return stop.value.code

    assert exit_code(bad, blend, other, "--closed", "CUT") == 1
    assert "bad.blend" in capsys.readouterr().err
    assert (folder / "in.blend").exists() and (folder / "other.blend").exists() and not (folder / "bad.blend").exists()
    assert exit_code(blend) == 1  # the cube is closed
    assert "Cube" in capsys.readouterr().err
    twin = tmp_path / "twin" / "in.blend"
    assert exit_code(blend, twin) == 2


def test_places_are_checked_before_any_work(addon, blend, tmp_path, capfd, factorizations):
    out = tmp_path / "out.blend"
    for arguments, told in (
        (("-o", tmp_path / "nowhere" / "out.blend"), "nowhere"),
        (("-o", out, "--json", tmp_path / "nowhere" / "report.json"), "nowhere"),
        (("-o", out, "--json", out), "-o and --json are both"),
        (("-o", out, "--json", blend), "--json is the input"),
        (("-o", "/dev/null"), "can not be written there"),
    ):
        assert run(addon, blend, *arguments) == 1
        assert told in capfd.readouterr().err
    assert not out.exists() and not factorizations


def test_numbers_that_can_not_be_written_keep_nothing_else_from_its_file(addon, blend, tmp_path, monkeypatch, capfd):
    import conformal_uv.files as files
    from conformal_uv import FileFormatError

    def failing(path):
        raise FileFormatError(f"{path}: no space left")

    monkeypatch.setattr(files, "replaced_file", failing)
    out = tmp_path / "out.blend"
    assert run(addon, blend, "-o", out, "--object", "Grid", "--json", tmp_path / "report.json") == 1
    assert out.exists() and "no space left" in capfd.readouterr().err


def test_collections(addon, tmp_path, capfd):
    """Objects in a collection, or in one inside it, and no others; options of packing reach the packer."""
    parts, inner = bpy.data.collections.new("Parts"), bpy.data.collections.new("Inner")
    bpy.context.scene.collection.children.link(parts)
    parts.children.link(inner)
    one, other, outside = (scenes.grid(name=name) for name in ("One", "Other", "Outside"))
    parts.objects.link(one)
    inner.objects.link(other)
    before = scenes.shadowed(scenes.uvs(outside))
    path, out, report = (tmp_path / name for name in ("in.blend", "out.blend", "report.json"))
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    packing = (
        "--place",
        "pack",
        "--pack-rotation",
        "any",
        "--margin-method",
        "pixels",
        "--margin",
        "4",
        "--tile",
        "1002",
    )
    assert run(addon, path, "-o", out, "--collection", "Parts", "--shape", "free", "--json", report, *packing) == 0
    bpy.ops.wm.open_mainfile(filepath=str(out))
    assert {ob["name"] for ob in json.loads(report.read_text())["objects"]} == {"One", "Other"}
    assert scenes.shadowed(scenes.uvs(bpy.data.objects["Outside"])) == before
    both = np.concatenate([scenes.uvs(bpy.data.objects[name]) for name in ("One", "Other")])
    assert both.min(axis=0) == pytest.approx([1.0 + 4 / 1024, 4 / 1024], abs=0.003)
    assert both[:, 0].max() <= 2.0 - 4 / 1024 + 1e-6
    assert run(addon, path, "-o", out, "--collection", "Nowhere") == 1
    assert "no collection named Nowhere" in capfd.readouterr().err
    assert run(addon, path, "-o", out, "--collection", "Parts", "--tile", "7") == 2
    assert "tile is 7" in capfd.readouterr().err
