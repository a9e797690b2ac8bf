"""Wheels of others for one zip, as the package index has them, unmodified."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from .errors import ReleaseError
from .extension_builds import PLATFORMS, Build

__all__ = ["bundled_wheels"]


def bundled_wheels(build: Build, folder: Path) -> list[Path]:
    """What a build brings, sorted by name; downloaded into a folder where it is not there yet.

    Raises
    ------
    ReleaseError
        If the index does not have one.
    """
    folder.mkdir(parents=True, exist_ok=True)
    return sorted(_wheel(requirement, build, folder) for requirement in build.requirements)


def _wheel(requirement: str, build: Build, folder: Path) -> Path:
    kept = _download(requirement, build, folder, "--no-index", "--find-links", str(folder))
    found = kept if isinstance(kept, Path) else _download(requirement, build, folder)
    if isinstance(found, Path):
        return found
    raise ReleaseError(f"no wheel of {requirement} for {build.python} on {build.platform}:\n{found}")


def _download(requirement: str, build: Build, folder: Path, *source: str) -> Path | str:
    """The wheel, or why there is none."""
    tags = [word for tag in PLATFORMS[build.platform] for word in ("--platform", tag)]
    with tempfile.TemporaryDirectory() as fresh:
        done = subprocess.run(
            [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary=:all:"]
            + ["--implementation", "cp", "--python-version", f"{build.python[2]}.{build.python[3:]}", *tags]
            + ["--dest", fresh, *source, requirement],
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode:
            return done.stderr
        wheel = next(Path(fresh).glob("*.whl"))
        return Path(shutil.copy(wheel, folder / wheel.name))
