"""One zip of the Blender extension: its files, its manifest and the wheels of others, checked by Blender."""

from __future__ import annotations

from pathlib import Path

from .blender_tool import BlenderTool
from .errors import ReleaseError
from .extension_builds import Build
from .extension_files import extension_files
from .extension_manifest import manifest
from .extension_wheels import bundled_wheels
from .reproducible import write_zip

__all__ = ["build_extension"]

LARGEST = 65_000_000  # bytes


def build_extension(
    repository: Path, build: Build, version: str, output: Path, wheels: Path, tool: BlenderTool, date: int
) -> Path:
    """Build and validate a zip.

    Parameters
    ----------
    repository : Path
    build : Build
    version : str
        The project's.
    output : Path
        Folder of the zip.
    wheels : Path
        Folder that keeps downloaded wheels.
    tool : BlenderTool
    date : int
        Of all entries, in seconds since 1970.

    Raises
    ------
    ReleaseError
        If a wheel is missing, the zip is too large, or Blender finds it not valid.
    """
    brought = bundled_wheels(build, wheels)
    files = extension_files(repository)
    files["blender_manifest.toml"] = manifest(build, version, (wheel.name for wheel in brought)).encode()
    files |= {f"wheels/{wheel.name}": wheel.read_bytes() for wheel in brought}
    path = output / build.filename(version)
    write_zip(path, files, date)
    if path.stat().st_size > LARGEST:
        raise ReleaseError(f"{path.name} has {path.stat().st_size} bytes, more than {LARGEST}")
    tool.validate(path)
    return path
