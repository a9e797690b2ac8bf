"""Branches of the commands and of what they share, each against what it is to do."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from meshes import annulus
from typer.testing import CliRunner

import conformal_uv as cuv
from conformal_uv import PolygonMesh
from conformal_uv.cli.app import app
from conformal_uv.cli.outputs import Outputs
from conformal_uv.console import stages
from conformal_uv.console.summary import distortion_summary
from conformal_uv.files import MeshFile, read_seams
from conformal_uv.pictures.figure import _joined


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("end", [None, 1, 2])
def test_an_edge_is_torn_where_one_of_its_ends_is(end: int | None, turned: bool) -> None:
    """Two triangles at the edge 1, 2, whose vertex `end` has another place in the second."""
    F = np.array([[0, 1, 2], [2, 1, 3]])
    if turned:
        F = F[::-1, [2, 1, 0]]
    mesh = PolygonMesh(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.0]]), F.reshape(-1), np.array([0, 3, 6]))
    uv = mesh.V[mesh.corners, :2].copy()
    corner = 3 + np.flatnonzero(F[1] == end)
    uv[corner] += 0.25
    seams = read_seams("uv", MeshFile(Path("two.obj"), mesh, uv))
    assert seams is not None and seams.tolist() == ([] if end is None else [[1, 2]])


@pytest.mark.parametrize("kind", ["mesh", "json", "plot"])
def test_nothing_else_goes_to_standard_output_with_a_file(kind: str, tmp_path: Path) -> None:
    """Whichever of the outputs a link leads there."""
    file = tmp_path / "file.svg"
    assert not Outputs(**{kind: file}).on_stdout
    file.symlink_to("/dev/stdout")
    assert Outputs(**{kind: file}).on_stdout


def test_seconds_of_a_stage_that_comes_again_add_up(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = iter([0.0, 1.0, 3.0, 7.0])
    monkeypatch.setattr(stages.time, "perf_counter", lambda: next(clock))
    with stages.Stages(quiet=True) as watch:
        for stage in ("factorization", "linear", "factorization"):
            watch(stage, 0.0)
    assert watch.seconds == {"factorization": 1.0 + 4.0, "linear": 2.0}


def test_numbers_without_bound_are_none_in_json() -> None:
    """JSON has no infinity: a face without area in the image has a ratio of singular values without bound."""
    V = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]
    d = cuv.distortion(V, [[0, 1, 2], [1, 3, 2]], [[0, 0], [1, 0], [0, 1], [0, 1]])
    told = distortion_summary(cuv.distortion_numbers([d]))
    assert told["quasi_conformal_ratio"] == {"median": None, "max": None}
    json.dumps(told, allow_nan=False)


def test_all_outputs_that_failed_are_told(tmp_path: Path) -> None:
    def failing(path: Path) -> None:
        raise cuv.FileFormatError(f"{path.name}: no room")

    outputs = Outputs(mesh=tmp_path / "a.obj", plot=tmp_path / "b.png", json=tmp_path / "c.json")
    with (
        pytest.raises(cuv.ConformalUVError, match=r"^a\.obj: no room; b\.png: no room$"),
        stages.Stages(quiet=True) as s,
    ):
        outputs.write(s, {"a": 1}, failing, failing)
    assert json.loads((tmp_path / "c.json").read_text()) == {"a": 1}


def test_the_report_measures_boundary_loops_in_the_units_of_the_file(tmp_path: Path) -> None:
    """A ring of 40 sides, its outer loop of radius 200."""
    V, F = annulus(40)
    np.savez(tmp_path / "ring.npz", V=100.0 * V, F=F)
    done = CliRunner().invoke(app, ["report", str(tmp_path / "ring.npz"), "--json", str(tmp_path / "told.json")])
    assert done.exit_code == 0, done.output
    lengths = [loop["length"] for loop in json.loads((tmp_path / "told.json").read_text())["boundary_loops"]]
    side = 2.0 * np.sin(np.pi / 40)
    assert sorted(lengths) == pytest.approx([100.0 * 40 * side, 200.0 * 40 * side], rel=1e-12)


def test_flipped_faces_of_every_chart_are_red_in_the_picture() -> None:
    """They are numbered through all charts, one after the other."""
    V = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]
    F = [[0, 1, 2], [1, 3, 2]]
    folded = cuv.distortion(V, F, [[0, 0], [1, 0], [0, 1], [0.1, 0.1]])
    charts = [SimpleNamespace(distortion=folded) for _ in range(3)]
    joined = _joined([charts[0], SimpleNamespace(distortion=None), *charts[1:]])
    assert folded.flipped.tolist() == [1] and joined.flipped.tolist() == [1, 3, 5]
    assert len(joined.angle_error) == 6
