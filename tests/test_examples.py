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


def test_there_are_examples() -> None:
    assert len(EXAMPLES) >= 8


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example(path: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    monkeypatch.setattr(sys, "argv", [str(path), str(tmp_path)])
    runpy.run_path(str(path), run_name="__main__")
    assert capsys.readouterr().out


@pytest.mark.parametrize(
    "name",
    [
        "disk_map",
        "unwrap",
        "sphere_map",
        "free_map",
        "rectangle_map",
        "distortion",
        "gradient",
        "face_areas",
        "mixed_voronoi_areas",
        "cotangent_laplacian",
        "cotangent_laplacian_intrinsic",
        "uniform_laplacian",
        "DiskMapper",
        "ShapeMapper",
        "Unwrapper",
        "Moebius",
        "unwrap_numbers",
        "distortion_numbers",
        "pack_together",
        "PolygonMesh",
        "triangulate",
        "Remedy",
    ],
)
def test_examples_in_docstrings(name: str) -> None:
    item = getattr(cuv, name)
    module = importlib.import_module(item.__module__)
    tests = doctest.DocTestFinder(recurse=False).find(item, name, module=module, globs={})
    assert tests and tests[0].examples, f"{name} has no example"
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    for test in tests:
        assert runner.run(test).failed == 0
