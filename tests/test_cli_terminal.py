"""What the commands print: no warning of another library, no traceback, nothing that commands a terminal."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from meshes import strip

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"


def run(*arguments: object, stdin: bytes | None = None) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [sys.executable, "-m", "conformal_uv", *map(str, arguments)], capture_output=True, input=stdin, check=False
    )


@pytest.mark.parametrize("command", ["disk", "report", "sphere"])
def test_control_characters_of_a_name_are_written_out(tmp_path: Path, command: str) -> None:
    name = tmp_path / "a\x1b[31m\u202eb.obj"
    name.write_text(SQUARE)
    target = [tmp_path / "c\x1b]0;x\x07.obj"] if command != "report" else []
    for source in (name, tmp_path / "missing\x1b[2J.obj"):
        ended = run(command, source, *target)
        told = ended.stdout + ended.stderr
        assert told
        assert b"\x1b" not in told and b"\x07" not in told and "\u202e".encode() not in told


def test_quiet_is_silent_where_the_method_does_not_converge(tmp_path: Path) -> None:
    """The report's algorithm stops on a strip before its tolerance, and the library logs it."""
    V, F = strip(9)
    source = tmp_path / "slivers.obj"
    lines = [f"v {x} {y} {z}" for x, y, z in V.tolist()] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in F.tolist()]
    source.write_text("\n".join(lines) + "\n")
    options = "--method", "augmented-lagrangian"
    loud = run("disk", source, tmp_path / "out.obj", *options)
    assert b"warning" in loud.stderr
    quiet = run("disk", source, tmp_path / "out.obj", "-q", *options)
    assert (quiet.returncode, quiet.stdout, quiet.stderr) == (0, b"", b"")


def test_report_of_a_face_without_area_prints_no_warning(tmp_path: Path) -> None:
    source = tmp_path / "flat.obj"
    source.write_text(SQUARE + "v 2 0 0\nf 1 5 2\n")
    ended = run("report", source)
    assert ended.returncode == 0
    assert b"Warning" not in ended.stderr and ended.stderr == b""


def test_a_damaged_stl_is_told_in_one_line(tmp_path: Path) -> None:
    source = tmp_path / "a.stl"
    source.write_bytes(b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n")
    ended = run("disk", source, tmp_path / "b.obj")
    assert ended.returncode == 1
    assert ended.stderr.count(b"\n") == 1 and ended.stderr.startswith(b"FileFormatError")


@pytest.mark.parametrize("count", ["99999999999", "0", "-5", "nan"])
def test_an_impossible_number_of_vertices_is_wrong_usage(tmp_path: Path, count: str) -> None:
    ended = run("sample", "mask", tmp_path / "a.obj", "--vertices", count)
    assert ended.returncode == 2
    assert b"Traceback" not in ended.stderr
    assert not (tmp_path / "a.obj").exists()
