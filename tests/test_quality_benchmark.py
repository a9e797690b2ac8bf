"""The benchmark of quality on two tiny meshes: its rows, its tables, and that what does not hold is found."""

from __future__ import annotations

import dataclasses
import importlib
from pathlib import Path
from types import ModuleType

import meshes as by_hand
import numpy as np
import pytest
from nasty_meshes import grid

REPOSITORY = Path(__file__).resolve().parent.parent
PEERS = "mesh\tshape\tprogram\tmean_angle_error_degrees\tfolded_faces\nsmall/disk\tdisk\tOther 1.0\t0.25\t0\n"


@pytest.fixture(autouse=True)
def from_repository(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(REPOSITORY))


def module(name: str) -> ModuleType:
    """A module of the benchmark, which is no installed package."""
    return importlib.import_module(f"benchmarks.quality.{name}")


@pytest.fixture
def command(tmp_path: Path):
    """The command over a disk and a closed mesh in a folder of their own; its options follow."""
    (tmp_path / "data" / "small").mkdir(parents=True)
    (tmp_path / "data" / "peers.tsv").write_text(PEERS, encoding="utf-8")
    for name, (V, F) in {"disk": grid(9, 9, 1.0, 1.0), "ball": by_hand.icosahedron()}.items():
        lines = [f"v {x!r} {y!r} {z!r}\n" for x, y, z in V.tolist()]
        lines += [f"f {a} {b} {c}\n" for a, b, c in (F + 1).tolist()]
        (tmp_path / "data" / "small" / f"{name}.obj").write_text("".join(lines), encoding="utf-8")
    given = ["--data", str(tmp_path / "data"), "--rows", str(tmp_path / "rows"), "--out", str(tmp_path / "quality.md")]
    given += ["--only", "small/disk", "small/ball"]
    return lambda *options: module("__main__").main([*given, *options])


def test_rows_tables_and_violations(command, tmp_path: Path) -> None:
    rows = module("rows")
    command()
    maps = rows.read_rows(tmp_path / "rows" / "maps.jsonl", rows.MapRow)
    changes = rows.read_rows(tmp_path / "rows" / "changes.jsonl", rows.ChangeRow)
    own = {(row.mesh, row.method): row for row in maps}
    assert {method for mesh, method in own if mesh == "small/disk"} == {"linear", "newton", "auto", "always"}
    assert {method for mesh, method in own if mesh == "small/ball"} >= {"linear", "schwarz", "newton", "auto"}
    assert sum(row.mesh == "small/disk" for row in changes) == 10
    disk = own["small/disk", "auto"]
    assert disk.off <= 1e-12 and disk.mean <= disk.rms <= disk.largest and disk.vertices == 81
    text = (tmp_path / "quality.md").read_text(encoding="utf-8")
    line = next(line for line in text.splitlines() if line.startswith("| small/disk "))
    assert f"{disk.mean:.3f} / {disk.rms:.2f} / {disk.largest:.0f}" in line and "Other 1.0 0.25" in line
    assert str(tmp_path) not in text
    assert command("--resume") == command("--report")
    assert len(rows.read_rows(tmp_path / "rows" / "maps.jsonl", rows.MapRow)) == len(maps)

    made_up = dataclasses.replace(disk, mean=disk.mean + 0.03)
    rows.append_row(tmp_path / "rows" / "maps.jsonl", made_up)
    assert command("--report") == 1
    assert f"{disk.mean + 0.03:.3f}" in (tmp_path / "quality.md").read_text(encoding="utf-8")


def test_sound_rows_break_nothing_and_each_check_is_found() -> None:
    rows, checks = module("rows"), module("checks")
    numbers = {"mean": 1.0, "rms": 1.5, "largest": 9.0, "seconds": 1.0, "status": "converged"}
    sound = {
        method: rows.MapRow("m", "disk", 9, method, chosen="newton", **numbers)
        for method in ("linear", "newton", "auto", "always")
    }
    same = rows.ChangeRow("m", "shift", "newton", "newton", 1e-7)
    assert checks.violations(list(sound.values()), [same]) == []
    broken = {
        checks.BETTER: ("auto", {"mean": 1.03}),
        checks.ENDED: ("newton", {"status": "stalled"}),
        checks.CIRCLE: ("linear", {"off": 2e-12}),
        checks.EMBEDDED: ("always", {"folds": 1}),
        checks.CHEAP: ("auto", {"folds": 1}),
        checks.MAPPED: ("newton", {"error": "SolverError"}),
    }
    for check, (method, change) in broken.items():
        changed = {**sound, method: dataclasses.replace(sound[method], **change)}
        assert [v.check for v in checks.violations(list(changed.values()), [])] == [check]
    for change in ({"after": "linear"}, {"difference": 2e-6}, {"difference": np.nan}):
        assert len(checks.violations([], [dataclasses.replace(same, **change)])) == 1


def test_an_error_is_a_row(monkeypatch: pytest.MonkeyPatch) -> None:
    measure = module("measure")
    row = measure.measured("torus", by_hand.torus(), "auto", 60.0)
    assert row.error == "TopologyError" and not module("checks").violations([row], [])[0].told.startswith("newton")
    row = measure.measured("plate", by_hand.plate(8, 8), "auto", -1.0)
    assert row.error == "CancelledError"
