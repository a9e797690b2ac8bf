"""Blender's Python: a process of its own, for bpy shares none with pymeshlab (embree's symbols clash)."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from functools import cache
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parent.parent
VARIABLE = "CONFORMAL_UV_BPY_PYTHON"
INSTALLED = "CONFORMAL_UV_BLENDER_MODULE"  # of an extension that brings scipy, under BLENDER_USER_RESOURCES
FOLDER = REPOSITORY / "tests" / "blender"
TIME_LIMIT = 900.0


def blender_python() -> str:
    """The interpreter that CONFORMAL_UV_BPY_PYTHON names, else this one."""
    return os.environ.get(VARIABLE) or sys.executable


@cache
def missing_blender() -> str:
    """Why Blender's tests can not run, empty where they can."""
    if not os.environ.get(VARIABLE) and importlib.util.find_spec("bpy") is None:
        return f"bpy is not installed; pip install bpy, or set {VARIABLE} to a Python that has it"
    found = run_python("-c", "import bpy, pytest" + ("" if os.environ.get(INSTALLED) else ", scipy"))
    return "" if found.returncode == 0 else f"{blender_python()}: {found.stderr.strip().splitlines()[-1]}"


def run_python(*arguments: str, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run Blender's Python; the environment is this one's with some variables set."""
    return subprocess.run(
        [blender_python(), *arguments],
        env={**os.environ, **variables},
        cwd=REPOSITORY,
        capture_output=True,
        text=True,
        timeout=TIME_LIMIT,
        check=False,
    )


def run_tests(*arguments: str, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run pytest on files of tests/blender, inside Blender's process."""
    return run_python(
        "-m", "pytest", "-c", str(FOLDER / "pytest.ini"), *arguments, CONFORMAL_UV_INSIDE_BLENDER="1", **variables
    )
