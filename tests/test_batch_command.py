"""conformal-uv batch, run as a user runs it."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from meshes_closed import icosphere
from typer.testing import CliRunner

import conformal_uv as cuv
from benchmarks.batch.meshes import write_broken, write_triangles
from conformal_uv.batches import BatchRow
from conformal_uv.cli import batch_page
from conformal_uv.cli.app import app
from conformal_uv.cli.batch_page import write_page
from conformal_uv.cli.map_options import COMMANDS, OF_ONE_FILE, map_parameters
from conformal_uv.files import read_mesh
from conformal_uv.samples import mask

COMMAND = [sys.executable, "-c", "from conformal_uv.cli.entry import main; main()", "batch"]


def run(*arguments: object, code: int = 0) -> str:
    """What the command prints, in this process."""
    done = CliRunner().invoke(app, ["batch", *map(str, arguments)])
    assert done.exit_code == code, done.output
    return " ".join(done.output.split())


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "in").mkdir()
    for number in (1, 2, 3):
        write_triangles(tmp_path / "in" / f"m{number}.obj", *mask(300 + number))
    return tmp_path


def test_maps_rows_and_a_page(folder: Path) -> None:
    pytest.importorskip("distributed")
    command = [*COMMAND, "in/*.obj", "--out", "out", "--workers", "2", "--method", "linear", "--upright", "none"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert re.search(r"Dask's dashboard: http://127\.0\.0\.1:\d+/status", done.stderr)
    assert "3 mapped" in done.stdout and "Traceback" not in done.stderr
    V, F = mask(301)
    written = read_mesh(folder / "out" / "m1.obj").corner_uv.reshape(-1, 3, 2)
    assert (written == (0.5 + 0.5 * cuv.disk_map(V, F, method="linear").uv)[F]).all()
    lines = [json.loads(line) for line in (folder / "out" / "rows.jsonl").read_text().splitlines()]
    assert {line["options"] for line in lines} == {'{"method": "linear", "upright": "none"}'}
    again = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300)
    assert again.returncode == 0 and "3 of them in earlier runs" in again.stdout


def test_one_broken_mesh_makes_the_exit_code_1(folder: Path) -> None:
    write_broken(folder / "in", "closed", "c", *mask(300))
    told = run(folder / "in", "--out", folder / "out", "--workers", 0, "--map", "free", code=1)
    assert "refused 1 can not be mapped" in told and "use --closed cut" in told
    assert run(folder / "in", "--out", folder / "out", "--workers", 0, "--map", "free", "-q", code=1) == ""
    page = (folder / "out" / "summary.html").read_text()
    assert "c.ply" in page and "TopologyError" in page


def test_options_of_another_map_are_refused_and_values_too(folder: Path) -> None:
    rest = [folder / "in", "--out", folder / "out", "--workers", 0]
    assert "--refine: no option of --map disk" in run(*rest, "--refine", code=1)
    assert "method is 'schwarz'" in run(*rest, "--method", "schwarz", code=1)
    assert "is not three vertex numbers" in run(*rest, "--pins", "1,2", code=2)
    assert run(*rest, "--method", "magic", code=2)
    assert not (folder / "out").exists()


def test_every_option_of_the_commands_is_one_of_the_batch() -> None:
    from inspect import signature

    names = {one.name for one in map_parameters()}
    for command in COMMANDS.values():
        assert set(signature(command).parameters) - OF_ONE_FILE <= names


@pytest.mark.parametrize("split", [[], ["--split"]])
def test_spheres(tmp_path: Path, split: list[str]) -> None:
    V, F = icosphere(2)
    (tmp_path / "in").mkdir()
    for number in (1, 2):
        write_triangles(tmp_path / "in" / f"s${number}.ply", V * [1, 1, number], F)
    options = ["--map", "sphere", "--landmarks", "0,1,2", "--uv", "octahedral", *split]
    told = run(tmp_path / "in", "--out", tmp_path / "out", "--workers", 0, *options)
    assert "2 mapped" in told
    page = (tmp_path / "out" / "summary.html").read_text()
    assert page.count("data:image/png;base64,") == 3 and "s$1.ply" in page  # the histograms, and a picture each


def test_the_page_stands_alone_and_shows_the_worst(folder: Path) -> None:
    for number in range(12):
        write_triangles(folder / "in" / f"n{number}.ply", *mask(60 + 5 * number))
    run(folder / "in", "--out", folder / "out", "--workers", 0)
    page = (folder / "out" / "summary.html").read_text()
    assert page.count("data:image/png;base64,") == 11 and not re.search(r'(src|href)="(?!data:)', page)
    rows = [json.loads(line) for line in (folder / "out" / "rows.jsonl").read_text().splitlines()]
    worst = sorted(rows, key=lambda row: -row["angle_mean"])[:10]
    assert re.findall(r"<figcaption>(.*?): mean", page) == [row["input"] for row in worst]


def test_a_page_of_what_can_not_be_drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    row = BatchRow(
        input="<b>.ply", output=str(tmp_path / "gone.ply"), status="done", map="disk", angle_mean=1.0, angle_max=2.0
    )
    page = write_page(tmp_path, [row]).read_text()
    assert "&lt;b&gt;.ply" in page and "<b>" not in page and "gone.ply" in page
    write_triangles(tmp_path / "gone.ply", *mask(100))
    assert "has no texture coordinates any more" in write_page(tmp_path, [row]).read_text()
    monkeypatch.setattr(batch_page, "find_spec", lambda name: None)
    assert "conformal-uv[plot]" in write_page(tmp_path, [row]).read_text()


def gone(group: int, seconds: float = 20.0) -> bool:
    """Whether a group of processes comes to its end."""
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.1)
    return False


@pytest.mark.skipif(os.name != "posix", reason="signals to a group of processes")
@pytest.mark.parametrize("name", ["SIGINT", "SIGKILL"])
def test_the_run_after_an_interrupted_one_goes_on(name: str, tmp_path: Path) -> None:
    """Ctrl-C at a terminal goes to the command and its workers, SIGKILL to the command alone."""
    how = getattr(signal, name)
    pytest.importorskip("distributed")
    (tmp_path / "in").mkdir()
    for number in range(60):
        write_triangles(tmp_path / "in" / f"m{number}.ply", *mask(2500, seed=number))
    command = [*COMMAND, "in", "--out", "out", "--workers", "2"]
    began = subprocess.Popen(
        command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    lines = tmp_path / "out" / "rows.jsonl"
    until = time.monotonic() + 120
    while (
        began.poll() is None
        and time.monotonic() < until
        and not (lines.exists() and lines.read_text().count("\n") >= 3)
    ):
        time.sleep(0.05)
    (os.killpg if how is signal.SIGINT else os.kill)(began.pid, how)
    _, errors = began.communicate(timeout=120)
    assert began.returncode == (130 if how is signal.SIGINT else -how), errors
    assert "Traceback" not in errors
    done = lines.read_text().count("\n")
    assert 3 <= done < 60
    if how is signal.SIGINT:
        assert (tmp_path / "out" / "rows.csv").read_text().count("\n") == done + 1
    assert gone(began.pid), "workers go on without the command"
    told = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert told.returncode == 0 and f"60, {done} of them in earlier runs" in told.stdout
    assert lines.read_text().count("\n") == 60 and not list((tmp_path / "out").glob(".*.tmp"))
