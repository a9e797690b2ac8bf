"""Ctrl-C while the commands load and work."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(os.name != "posix", reason="sends SIGINT")

# Sends itself SIGINT when the named module begins to load.
FINDER = """
import os, signal, sys
class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == os.environ["INTERRUPT_AT"]:
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Finder())
"""


def interrupted(tmp_path: Path, module: str, at: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """The command, interrupted where it imports a module."""
    (tmp_path / "sitecustomize.py").write_text(FINDER)
    paths = [str(tmp_path), *filter(None, [os.environ.get("PYTHONPATH")])]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths), "INTERRUPT_AT": at}
    return subprocess.run(
        [sys.executable, "-m", module, *arguments],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )


@pytest.mark.parametrize("module", ["conformal_uv", "meshlab_filter"])
@pytest.mark.parametrize("at", ["typer", "numpy", "scipy.sparse", "conformal_uv.charts", "rich.progress"])
def test_loading(tmp_path: Path, module: str, at: str) -> None:
    if module == "meshlab_filter":
        pytest.importorskip("pymeshlab")
    ended = interrupted(tmp_path, module, at, "--help")
    assert (ended.returncode, ended.stdout, ended.stderr) == (130, "", "")


def test_working(tmp_path: Path) -> None:
    """cvxopt or SuperLU is imported when the first map is made."""
    mesh = tmp_path / "a.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n")
    at = "cvxopt" if _has("cvxopt") else "scipy.sparse.linalg"
    ended = interrupted(tmp_path, "conformal_uv", at, "disk", str(mesh), str(tmp_path / "b.obj"))
    assert ended.returncode == 130
    assert "Traceback" not in ended.stderr
    assert not (tmp_path / "b.obj").exists()


def _has(name: str) -> bool:
    import importlib.util

    return importlib.util.find_spec(name) is not None
