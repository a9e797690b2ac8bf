"""The inputs of a batch and its options: what is found where, and what is refused before any work."""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
import pytest

from conformal_uv.batches.estimate import estimated_memory, estimated_vertices
from conformal_uv.batches.inputs import found_tasks
from conformal_uv.batches.plan import Plan
from conformal_uv.batches.row import BatchRow
from conformal_uv.batches.task import Task
from conformal_uv.errors import FileFormatError, MissingDependencyError, OptionError
from conformal_uv.options import MapKind

DISK = Plan.of("disk", {})


@pytest.fixture
def scans(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """scans/lh.ply, scans/one/lh.ply, scans/two/lh.stl and files that are no meshes; the working folder is theirs."""
    folder = tmp_path / "scans"
    for name in ("lh.ply", "one/lh.ply", "two/lh.stl", "two/rh.obj.gz", "two/notes.txt", "one/.hidden.ply"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("")
    monkeypatch.chdir(tmp_path)
    return folder


def places(inputs: object, out: str = "maps", plan: Plan = DISK) -> dict[str, str]:
    """Where the maps go, below `out`, by their meshes as seen from here."""
    tasks = found_tasks(inputs, Path(out), plan, {})
    return {os.path.relpath(task.source): os.path.relpath(task.target, out) for task in tasks}


ALL = {
    "scans/lh.ply": "lh.ply",
    "scans/one/lh.ply": "one/lh.ply",
    "scans/two/lh.stl": "two/lh.obj",
    "scans/two/rh.obj.gz": "two/rh.obj",
}


def test_folders_patterns_and_files(scans: Path) -> None:
    assert places("scans") == places(scans) == ALL
    assert places("scans/**/lh.*") == {name: place for name, place in ALL.items() if "rh" not in name}
    assert places(["scans/one/lh.ply", "scans/two/lh.stl"]) == {
        "scans/one/lh.ply": "one/lh.ply",
        "scans/two/lh.stl": "two/lh.obj",
    }
    assert places("scans/one/lh.ply") == {"scans/one/lh.ply": "lh.ply"}
    assert places("not there.ply") == {"not there.ply": "not there.ply"}  # its row will tell
    assert places(["scans", "scans/*/lh.ply", scans / "lh.ply"]) == ALL  # each once


def test_the_format_of_the_maps(scans: Path) -> None:
    plan = Plan.of("disk", {"format": "npz"})
    assert set(places("scans", plan=plan).values()) == {"lh.npz", "one/lh.npz", "two/lh.npz", "two/rh.npz"}


def test_maps_among_the_meshes_are_no_meshes(scans: Path) -> None:
    (scans / "maps").mkdir()
    (scans / "maps" / "lh.ply").write_text("")
    assert places("scans", out="scans/maps") == ALL


def test_a_map_replaces_no_mesh_and_no_other_map(scans: Path) -> None:
    with pytest.raises(OptionError, match="would be replaced"):
        places("scans", out="scans")
    (scans / "one" / "lh.obj").write_text("")
    (scans / "one" / "lh.off").write_text("")
    with pytest.raises(OptionError, match="would both be mapped to .*one/lh.obj"):
        places("scans")
    for nothing in ([], "scans/*.off", ["scans/*.off"]):
        with pytest.raises(OptionError, match="No "):
            places(nothing)
    (scans / "empty").mkdir()
    with pytest.raises(OptionError, match="No meshes in scans/empty"):
        places("scans/empty")


def test_a_manifest_in_csv(scans: Path) -> None:
    (scans / "list.csv").write_text(
        "input,output,map,pins,center,margin,refine,upright\n"
        "one/lh.ply,,,,12,0.01,,y\n"
        'two/lh.stl,a/b.ply,disk,"0, 31,62",,,,\n'
        "lh.ply,,free,,,,true,\n"
    )
    tasks = found_tasks("scans/list.csv", Path("maps"), Plan.of("disk", {"upright": "none"}), {})
    assert [os.path.relpath(task.target, "maps") for task in tasks] == ["one/lh.ply", "a/b.ply", "lh.ply"]
    assert [task.plan.given for task in tasks] == [
        {"center": 12, "margin": 0.01, "upright": "y"},
        {"pins": [0, 31, 62], "upright": "none"},
        {"refine": True, "upright": "none"},
    ]
    assert [task.plan.kind for task in tasks] == [MapKind.DISK, MapKind.DISK, MapKind.FREE]


def test_a_manifest_in_json(scans: Path) -> None:
    rows = ["one/lh.ply", {"input": str(scans / "lh.ply"), "output": "left.obj", "pins": [1, 2, 3], "center": None}]
    (scans / "list.json").write_text(json.dumps(rows))
    tasks = found_tasks(["scans/list.json"], Path("maps"), DISK, {})
    assert [os.path.relpath(task.target, "maps") for task in tasks] == ["lh.ply", "left.obj"]
    assert [task.plan.given for task in tasks] == [{}, {"pins": [1, 2, 3]}]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("missing.csv", None),
        ("a.csv", "file\nlh.ply\n"),
        ("a.csv", "input,center\nlh.ply\n"),
        ("a.csv", "input,center\nlh.ply,1,2\n"),
        ("a.csv", "input,center\n,1\n"),
        ("a.json", "{}"),
        ("a.json", "[1]"),
        ("a.json", "[{}]"),
        ("a.json", '[{"input": "a.ply", "output": 3}]'),
        ("a.json", '["a.ply"'),
    ],
)
def test_what_is_no_manifest(scans: Path, name: str, text: str | None) -> None:
    if text is not None:
        (scans / name).write_text(text)
    with pytest.raises(FileFormatError, match=name):
        places(scans / name)


def test_options_of_a_manifest_are_checked(scans: Path) -> None:
    (scans / "a.csv").write_text("input,method\nlh.ply,magic\n")
    with pytest.raises(OptionError, match="method is 'magic'"):
        places(scans / "a.csv")


@pytest.mark.parametrize(
    ("kind", "options", "told"),
    [
        ("cube", {}, "map is 'cube'; choose disk, free, rectangle, sphere"),
        ("disk", {"methode": "linear"}, "methode: no option of the map disk"),
        ("disk", {"shape": "free"}, "shape: no option"),
        ("disk", {"callback": print}, "callback is"),
        ("disk", {"method": "schwarz"}, "method is 'schwarz'"),
        ("sphere", {"method": "schwartz"}, "method is 'schwartz'"),
        ("sphere", {"holes": "fill"}, "holes: no option of the map sphere"),
        ("sphere", {"uv": "cube"}, "uv is 'cube'"),
        ("disk", {"pins": [0, 1, 2], "center": 3}, "Three pins already fix the map"),
        ("disk", {"pins": {0, 1, 2}}, "pins is a set"),
        ("disk", {"center": "middle"}, "center is 'middle'"),
        ("disk", {"laplacian": "uniform"}, "laplacian is 'uniform'"),
        ("disk", {"margin": 0.7}, "margin is 0.7"),
        ("free", {"closed": "open"}, "closed is 'open'"),
        ("disk", {"split": "yes"}, "split is 'yes'"),
        ("disk", {"format": "stl"}, "format is 'stl'"),
        ("disk", {"backend": "magic"}, "Unknown backend 'magic'"),
        ("rectangle", {"corner_choice": "best"}, "corner_choice is 'best'"),
    ],
)
def test_options_are_refused_before_any_work(kind: str, options: dict, told: str) -> None:
    with pytest.raises(OptionError, match=told.replace("(", r"\(")):
        Plan.of(kind, options)


def test_a_plan_is_its_options_in_order() -> None:
    plan = Plan.of("disk", {"upright": "y", "center": np.int64(3), "pins": None, "seams": Path("a.txt")})
    assert plan == Plan.of("disk", {"center": 3, "seams": "a.txt", "upright": "y"})
    assert plan.given == {"center": 3, "seams": os.path.abspath("a.txt"), "upright": "y"}
    assert Plan.of("rectangle", {"corners": np.arange(4)}).given == {"pins": [0, 1, 2, 3]}
    assert Plan.of("disk", {"pins": [0, 5, 9, 20, 22, 24]}).given["pins"][3] == 20  # of several charts


def test_a_backend_that_is_not_there(monkeypatch: pytest.MonkeyPatch) -> None:
    from conformal_uv.linear import backends

    monkeypatch.setattr(backends.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(MissingDependencyError):
        Plan.of("disk", {"backend": "cholmod"})


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".npz"])
def test_a_mesh_is_rather_taken_for_larger_than_it_is(suffix: str, tmp_path: Path) -> None:
    from benchmarks.batch.meshes import write_triangles
    from conformal_uv.samples import terrain

    path = str(tmp_path / f"a{suffix}")
    V, F = terrain(5000)
    write_triangles(Path(path), V, F)
    assert len(V) <= estimated_vertices(path) <= 8 * len(V)
    least, n = estimated_memory(0, MapKind.DISK), estimated_vertices(path)
    assert estimated_memory(n, MapKind.SPHERE) > estimated_memory(n, MapKind.DISK) > least > 1 << 26
    assert estimated_vertices(str(tmp_path / "missing.obj")) == 0


def test_what_gzip_packed_is_larger(tmp_path: Path) -> None:
    for name in ("a.obj", "a.obj.gz", "b"):
        (tmp_path / name).write_bytes(bytes(4000))
    assert [estimated_vertices(str(tmp_path / name)) for name in ("a.obj", "a.obj.gz", "b")] == [80, 320, 200]


def test_rows_come_back_from_what_is_stored() -> None:
    row = BatchRow(input="a", output="b", status="done", map="disk", angle_mean=0.1)
    assert BatchRow.restored(json.loads(json.dumps({**row.stored(), "of_another_version": 1}))) == row
    for stored in ({"input": "a", "output": "b", "map": "disk"}, {**row.stored(), "status": "?"}):
        with pytest.raises((KeyError, ValueError)):
            BatchRow.restored(stored)


def test_tasks_know_what_was_told_before(scans: Path) -> None:
    target = os.path.abspath("maps/lh.ply")
    row = BatchRow(input="a", output=target, status="done", map="disk")
    tasks = found_tasks("scans", Path("maps"), DISK, {target: row})
    assert [task.before for task in tasks] == [row, None, None, None]
    assert isinstance(tasks[0], Task)
