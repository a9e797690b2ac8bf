"""Invoke and modal in a real window: needs a Blender program, and a display or Xvfb.

CONFORMAL_UV_BLENDER names the program; its Python must have scipy, or the extension be installed in it
(CONFORMAL_UV_BLENDER_MODULE=bl_ext.user_default.conformal_uv).
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

PROGRAM = os.environ.get("CONFORMAL_UV_BLENDER", "")
SCRIPT = Path(__file__).with_name("blender_window.py")
CASES = re.findall(r"^def (case_\w+)", SCRIPT.read_text(encoding="utf-8"), re.MULTILINE)
TIME_LIMIT = 600.0

pytestmark = [
    pytest.mark.skipif(not PROGRAM, reason="CONFORMAL_UV_BLENDER names no Blender program"),
    pytest.mark.skipif(
        not os.environ.get("DISPLAY") and shutil.which("Xvfb") is None, reason="there is neither a display nor Xvfb"
    ),
]


@pytest.fixture(scope="module")
def display():
    """A display of its own where there is Xvfb, else the one at hand."""
    if shutil.which("Xvfb") is None:
        yield os.environ["DISPLAY"]
        return
    read, write = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x900x24"], pass_fds=[write], stderr=subprocess.DEVNULL
    )
    os.close(write)
    with os.fdopen(read) as number:
        yield f":{number.readline().strip()}"
    server.terminate()
    server.wait()


@pytest.fixture(scope="module")
def report(display, tmp_path_factory) -> dict[str, str]:
    folder = tmp_path_factory.mktemp("window")
    done = subprocess.run(
        [PROGRAM, "--factory-startup", "--enable-event-simulate", "--python-use-system-env", "--window-geometry"]
        + ["0", "0", "1280", "900", "--python", str(SCRIPT), "--", str(folder / "report.json")],
        env={
            **os.environ,
            "DISPLAY": display,
            "LIBGL_ALWAYS_SOFTWARE": "1",
            "BLENDER_USER_RESOURCES": os.environ.get("BLENDER_USER_RESOURCES", str(folder)),
            "PYTHONPATH": str(SCRIPT.parent.parent),
        },
        capture_output=True,
        text=True,
        timeout=TIME_LIMIT,
        check=False,
    )
    assert (folder / "report.json").is_file(), f"{done.stdout}\n{done.stderr}"
    return json.loads((folder / "report.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("case", CASES)
def test_in_a_window(report, case):
    assert report[case] == "", report[case]


def test_all_cases_ran(report):
    assert set(report) == set(CASES) and len(CASES) >= 8
