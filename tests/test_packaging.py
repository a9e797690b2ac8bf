"""What pip makes of the project: markers that every pip can evaluate, and what the wheel holds."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tomllib
import zipfile
from importlib.metadata import version
from pathlib import Path

import pytest
from packaging.requirements import Requirement

ROOT = Path(__file__).resolve().parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
EXTRAS = PROJECT["optional-dependencies"].values()
REQUIREMENTS = [*PROJECT["dependencies"], *(line for extra in EXTRAS for line in extra)]
# Names and versions of systems are no version numbers everywhere; pip 24.1 to 25.3 fail on comparing them as such.
SAFE = {"python_version", "python_full_version", "sys_platform", "platform_machine", "implementation_name", "os_name"}


def marked() -> list[str]:
    return [line for line in REQUIREMENTS if Requirement(line).marker is not None]


@pytest.mark.parametrize("line", marked())
def test_markers_ask_for_nothing_that_pip_can_not_evaluate(line: str) -> None:
    marker = str(Requirement(line).marker)
    names = set(re.findall(r"\b[a-z_]+\b", re.sub(r'"[^"]*"', "", marker))) - {"and", "or", "in", "not"}
    assert names and names <= SAFE


@pytest.mark.parametrize(
    ("system", "machine", "python", "named"),
    [
        ("linux", "x86_64", "3.11", True),
        ("linux", "aarch64", "3.13", True),
        ("win32", "AMD64", "3.12", True),
        ("win32", "ARM64", "3.12", False),  # no wheel: pip would start a compiler
        ("darwin", "arm64", "3.12", False),  # wheels for the newest releases of macOS alone
        ("darwin", "x86_64", "3.12", False),
        ("linux", "riscv64", "3.12", False),
        ("linux", "x86_64", "3.15", False),
    ],
)
def test_cvxopt_is_asked_for_where_there_are_wheels(system: str, machine: str, python: str, named: bool) -> None:
    environment = {
        "sys_platform": system,
        "platform_machine": machine,
        "python_version": python,
        "implementation_name": "cpython",
        "platform_release": "6.8.0-45-generic",
    }
    cvxopt = [Requirement(line) for line in PROJECT["dependencies"] if line.startswith("cvxopt")]
    assert any(r.marker is None or r.marker.evaluate(environment) for r in cvxopt) is named
    assert any(line.startswith("cvxopt") for line in PROJECT["optional-dependencies"]["cholmod"])


@pytest.mark.skipif(int(version("setuptools").split(".")[0]) < 77, reason="the build needs setuptools 77")
def test_the_wheel_holds_the_library_and_the_filter_alone(tmp_path: Path) -> None:
    source = tmp_path / "source"
    kept = shutil.ignore_patterns(".*", "build", "*.egg-info", "__pycache__", "node_modules")
    shutil.copytree(ROOT, source, ignore=kept)
    command = [sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "-w", str(tmp_path)]
    subprocess.run([*command, str(source)], check=True, capture_output=True)
    (wheel,) = tmp_path.glob("*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    assert {name.partition("/")[0] for name in names if ".dist-info" not in name} == {"conformal_uv", "meshlab_filter"}
    assert {"conformal_uv/py.typed", "meshlab_filter/py.typed"} <= set(names)
    assert {f"conformal_uv/page/assets/page.{kind}" for kind in ("html", "css", "js")} <= set(names)
    assert not any("node_modules" in name for name in names)
