"""Where the commands write: streams, devices, conflicts, and one output that fails."""

from __future__ import annotations

import io
import json
import os
import stat
import threading
from pathlib import Path

import numpy as np
import pytest
from test_cli_terminal import SQUARE, run

from conformal_uv.files import read_mesh, replaced_file

posix = pytest.mark.skipif(os.name != "posix", reason="devices and FIFOs")


@pytest.fixture
def square(tmp_path: Path) -> Path:
    path = tmp_path / "a.obj"
    path.write_text(SQUARE)
    return path


def test_dash_is_standard_input_and_output(square: Path, tmp_path: Path) -> None:
    run("disk", square, tmp_path / "b.obj", "-q")
    piped = run("disk", "-", "-", stdin=square.read_bytes())
    assert piped.returncode == 0
    assert piped.stdout == (tmp_path / "b.obj").read_bytes()
    assert b"angle error" in piped.stderr


@pytest.mark.parametrize("format", ["ply", "npz"])
def test_dash_with_a_binary_format(square: Path, tmp_path: Path, format: str) -> None:
    made = run("disk", square, "-", "--format", format, "-q")
    assert made.returncode == 0
    again = run("disk", "-", tmp_path / "c.obj", "--format", format, "-q", stdin=made.stdout)
    assert again.returncode == 0, again.stderr
    (tmp_path / f"b.{format}").write_bytes(made.stdout)
    assert len(read_mesh(tmp_path / f"b.{format}").mesh.sizes) == 2


def test_json_on_standard_output_is_json_alone(square: Path, tmp_path: Path) -> None:
    ended = run("disk", square, tmp_path / "b.obj", "--json", "-")
    assert json.loads(ended.stdout)["flipped_faces"] == 0
    assert json.loads(run("report", square, "--json", "-").stdout)["triangles"] == 2


def test_empty_standard_input_is_told(tmp_path: Path) -> None:
    ended = run("disk", "-", tmp_path / "b.obj", stdin=b"")
    assert ended.returncode == 1 and b"FileFormatError" in ended.stderr


@posix
def test_a_log_behind_dev_stdout_keeps_its_content(square: Path, tmp_path: Path) -> None:
    log = tmp_path / "log"
    log.write_bytes(b"before\n")
    with log.open("ab") as stream:
        import subprocess
        import sys

        command = [sys.executable, "-m", "conformal_uv", "disk", str(square), "/dev/stdout", "--format", "obj", "-q"]
        subprocess.run(command, stdout=stream, check=True)
    assert log.read_bytes().startswith(b"before\nv 0")


@posix
def test_a_fifo_and_a_link_to_a_device_are_written_into(tmp_path: Path) -> None:
    fifo = tmp_path / "fifo"
    os.mkfifo(fifo)
    read = io.BytesIO()
    reader = threading.Thread(target=lambda: read.write(fifo.read_bytes()))
    reader.start()
    with replaced_file(fifo) as out:
        out.write(b"through")
    reader.join(10)
    assert read.getvalue() == b"through" and stat.S_ISFIFO(fifo.stat().st_mode)
    link = tmp_path / "null"
    link.symlink_to("/dev/null")
    with replaced_file(link) as out:
        out.write(b"gone")
    assert link.is_symlink() and stat.S_ISCHR(link.stat().st_mode)


def test_conflicting_outputs_are_refused_before_any_work(square: Path, tmp_path: Path) -> None:
    before = square.read_bytes()
    for arguments in (
        (square, tmp_path / "b.obj", "--json", tmp_path / "b.obj"),
        (square, tmp_path / "b.obj", "--json", square),
        (square, "-", "--json", "-"),
        (square, tmp_path / "b.obj", "--json", tmp_path / "." / "b.obj"),
    ):
        ended = run("disk", *arguments)
        assert ended.returncode != 0 and b"OptionError" in ended.stderr
        assert not (tmp_path / "b.obj").exists() and square.read_bytes() == before
    os.link(square, tmp_path / "same.json")
    assert run("disk", square, tmp_path / "b.obj", "--json", tmp_path / "same.json").returncode != 0
    assert run("disk", square, square, "-q").returncode == 0


def test_every_place_is_checked_first(square: Path, tmp_path: Path) -> None:
    for option in ("--json", "--plot"):
        ended = run("disk", square, tmp_path / "b.obj", option, tmp_path / "missing" / "x.png")
        assert ended.returncode == 1 and b"missing" in ended.stderr
        assert not (tmp_path / "b.obj").exists()


@posix
def test_an_output_that_fails_leaves_the_others(square: Path, tmp_path: Path) -> None:
    if not Path("/dev/full").exists():
        pytest.skip("no /dev/full")
    ended = run("disk", square, "/dev/full", "--format", "obj", "--json", tmp_path / "b.json")
    assert ended.returncode == 1 and b"/dev/full" in ended.stderr
    assert json.loads((tmp_path / "b.json").read_text())["flipped_faces"] == 0


def test_split_vertices_carry_the_uvs_and_their_origin(tmp_path: Path) -> None:
    """Two squares with a seam between them: four corners more than vertices."""
    source = tmp_path / "a.obj"
    source.write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nf 1 2 5 4\nf 2 3 6 5\n")
    seams = tmp_path / "seams.txt"
    seams.write_text("1 4\n")
    whole, split = tmp_path / "whole.npz", tmp_path / "split.npz"
    assert run("disk", source, whole, "--seams", seams, "-q").returncode == 0
    assert run("disk", source, split, "--seams", seams, "--split", "-q").returncode == 0
    kept, made = np.load(whole), np.load(split)
    assert len(kept["V"]) == 6 and len(made["V"]) == 8
    original = made["original_vertex"]
    np.testing.assert_array_equal(made["V"], kept["V"][original])
    np.testing.assert_array_equal(original[made["corners"]], kept["corners"])
    np.testing.assert_array_equal(made["uv"][made["corners"]], kept["corner_uv"])
