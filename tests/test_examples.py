"""The examples of the core run and hold what they assert; so do those in docstrings."""

from __future__ import annotations

import doctest
import importlib
import runpy
import sys
from pathlib import Path

import pytest

import conformal_uv as cuv

EXAMPLES = sorted((Path(__file__).resolve().parent.parent / "examples" / "core").glob("*.py"))
FUNCTIONS = [name for name in cuv.__all__ if getattr(getattr(cuv, name), "__module__", "").startswith("conformal_uv")]
# Errors have the example of their base, results of maps and their parts that of the map; the sphere's layouts none yet.
ERRORS = {
    name for name in FUNCTIONS if isinstance(getattr(cuv, name), type) and issubclass(getattr(cuv, name), Exception)
}
RESULTS = {
    "AugmentedLagrangianStep",
    "DiskIsland",
    "DiskMap",
    "FreeMap",
    "IslandSurface",
    "NewtonStep",
    "RectangleMap",
    "Repair",
    "SphereMap",
    "StoredSphere",
    "UVIslands",
}
OVER_MPI = {
    "DistributedDiskMap",
    "distributed_disk_map",
}  # docs/scale.md shows them, tests/test_distributed.py runs them
SHOWN_ELSEWHERE = RESULTS | OVER_MPI | {"equirectangular", "octahedral"} | ERRORS - {"ConformalUVError"}


def test_there_are_examples() -> None:
    assert len(EXAMPLES) >= 8


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example(path: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    monkeypatch.setattr(sys, "argv", [str(path), str(tmp_path)])
    runpy.run_path(str(path), run_name="__main__")
    assert capsys.readouterr().out


def test_picture_of_the_shapes(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    pytest.importorskip("matplotlib")
    script = EXAMPLES[0].parent.parent / "pictures" / "shapes_side_by_side.py"
    monkeypatch.setattr(sys, "argv", [str(script), str(tmp_path / "shapes.png")])
    runpy.run_path(str(script), run_name="__main__")
    told = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in told] == ["disk", "free", "rectangle", "sphere"]
    assert all(line.endswith(" 0 folds") for line in told)
    assert float(told[1].split()[1]) < float(told[0].split()[1])  # a free boundary keeps angles better than a circle
    assert (tmp_path / "shapes.png").read_bytes()[:4] == b"\x89PNG"


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if name not in SHOWN_ELSEWHERE])
def test_examples_in_docstrings(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # some write files
    item = getattr(cuv, name)
    module = importlib.import_module(item.__module__)
    tests = doctest.DocTestFinder(recurse=False).find(item, name, module=module, globs={})
    assert tests and tests[0].examples, f"{name} has no example"
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    for test in tests:
        assert runner.run(test).failed == 0
