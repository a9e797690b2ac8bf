"""The project's wheel and source distribution."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from .errors import ReleaseError
from .reproducible import rewritten_sdist, rewritten_wheel

__all__ = ["build_packages"]

SOURCES = ("conformal_uv", "meshlab_filter", "web", "pyproject.toml", "MANIFEST.in", "README.md", "LICENSE")


def build_packages(repository: Path, output: Path, date: int) -> list[Path]:
    """Build both from a copy, so that nothing is left in the repository and nothing of older builds gets in.

    Raises
    ------
    ReleaseError
        If they can not be built; `build` is needed.
    """
    with tempfile.TemporaryDirectory() as folder:
        source, made = Path(folder) / "source", Path(folder) / "made"
        source.mkdir()
        for name in SOURCES:
            given = repository / name
            if given.is_dir():
                shutil.copytree(given, source / name, ignore=shutil.ignore_patterns("__pycache__", "node_modules"))
            else:
                shutil.copy(given, source / name)
        done = subprocess.run(
            [sys.executable, "-m", "build", "--outdir", str(made), str(source)],
            env={**os.environ, "SOURCE_DATE_EPOCH": str(date)},
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode:
            raise ReleaseError(f"wheel and sdist could not be built:\n{done.stdout}{done.stderr}")
        (wheel,), (sdist,) = made.glob("*.whl"), made.glob("*.tar.gz")
        rewritten_wheel(wheel, date)
        rewritten_sdist(sdist, date)
        return [Path(shutil.copy(path, output / path.name)) for path in (wheel, sdist)]
