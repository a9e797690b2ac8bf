"""Blender's own command for extensions, out of the bpy wheel: what it takes for valid, and for one of a kind."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from collections.abc import Iterable
from pathlib import Path

from .errors import ReleaseError

__all__ = ["BlenderTool"]


class BlenderTool:
    """`blender_ext.py` of a bpy.

    Parameters
    ----------
    python : str
        One that has bpy.

    Raises
    ------
    ReleaseError
        If it has none.
    """

    def __init__(self, python: str) -> None:
        spec = "import importlib.util as u; print(u.find_spec('bpy').origin)"
        try:
            said = subprocess.run([python, "-c", spec], capture_output=True, text=True, check=True).stdout.strip()
        except (OSError, subprocess.CalledProcessError):
            said = ""
        tools = sorted(Path(said).parent.glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py")) if said else []
        if not tools:
            raise ReleaseError(f"{python} has no bpy: pip install bpy, or name a Python that has it with --bpy-python")
        self._command = [python, str(tools[0])]
        tags = tools[0].parents[3] / "modules" / "_bpy_internal" / "extensions" / "tags.py"
        self._tags = ["--valid-tags", str(tags)] if tags.exists() else []

    def validate(self, path: Path) -> None:
        """Let Blender check a zip. Raises ReleaseError with what it says."""
        self._run("validate", *self._tags, str(path))

    def check_distinct(self, paths: Iterable[Path]) -> None:
        """Let Blender list zips as one repository; no Blender may find two that it could install."""
        with tempfile.TemporaryDirectory() as folder:
            for path in paths:
                shutil.copy(path, folder)
            said = self._run("server-generate", "--repo-dir", folder)
        if "duplicate" in said:
            raise ReleaseError(f"two zips are for the same Blender:\n{said}")

    def _run(self, *arguments: str) -> str:
        done = subprocess.run([*self._command, *arguments], capture_output=True, text=True, check=False)
        if done.returncode:
            raise ReleaseError(f"blender_ext.py {' '.join(arguments)}\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr
