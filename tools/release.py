"""Build everything that is released: the Blender extension's zips, the Python package, the site and their checksums.

    python -m tools.release [--output dist] [--bpy-python PYTHON]
    python -m tools.release --platform linux-x64 --python cp311      # one zip alone
    python -m tools.release --platform distribution                  # the one without wheels

Every zip is validated by Blender's own tool, out of the bpy wheel. Of the same files and at the same commit (or
SOURCE_DATE_EPOCH) the same bytes come out. What has been built is printed. docs/releasing.md tells more.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import shutil
import sys
import tempfile
from pathlib import Path

from .blender_tool import BlenderTool
from .build_extension import build_extension
from .conda_recipe import write_recipe
from .errors import ReleaseError
from .extension_builds import BUILDS, DISTRIBUTION, PLATFORMS, PYTHONS, Build
from .python_packages import build_packages
from .reproducible import source_date
from .site import build_site
from .versions import agreed_version

REPOSITORY = Path(__file__).resolve().parent.parent
ANY = "distribution"


def main(argv: list[str] | None = None) -> int:
    """Build what the arguments ask for; exit code 1 and a message where something must be mended first."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=Path, default=REPOSITORY / "dist")
    parser.add_argument("--platform", action="append", choices=[*PLATFORMS, ANY], help="zips for these alone")
    parser.add_argument("--python", action="append", choices=list(PYTHONS), help="zips for these alone")
    parser.add_argument("--wheels", type=Path, default=REPOSITORY / "build" / "wheels", help="keeps downloaded wheels")
    parser.add_argument("--bpy-python", default=os.environ.get("CONFORMAL_UV_BPY_PYTHON", sys.executable))
    arguments = parser.parse_args(argv)
    whole = not (arguments.platform or arguments.python)
    builds = chosen_builds(arguments.platform or [*PLATFORMS, ANY], arguments.python or list(PYTHONS))
    if not builds:
        parser.error("no such zip: scipy has no wheel for it")
    try:
        built = release(builds, arguments.output, arguments.wheels, arguments.bpy_python, whole=whole)
    except ReleaseError as error:
        sys.stderr.write(f"{error}\n")
        return 1
    for path in built:
        sys.stdout.write(f"{path}\n")
    return 0


def chosen_builds(platforms: list[str], pythons: list[str]) -> list[Build]:
    """The zips for these platforms and Pythons."""
    found = [build for build in BUILDS if build.platform in platforms and build.python in pythons]
    return found + ([DISTRIBUTION] if ANY in platforms else [])


def release(builds: list[Build], output: Path, wheels: Path, bpy_python: str, *, whole: bool) -> list[Path]:
    """Build zips, and for a whole release wheel, sdist and SHA256SUMS; nothing is handed over before all is built."""
    version, date, tool = agreed_version(REPOSITORY), source_date(REPOSITORY), BlenderTool(bpy_python)
    output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=output) as folder:
        fresh = Path(folder)
        zips = [build_extension(REPOSITORY, build, version, fresh, wheels, tool, date) for build in builds]
        tool.check_distinct(path for path, build in zip(zips, builds, strict=True) if build is not DISTRIBUTION)
        built = zips
        if whole:
            wheel, sdist = build_packages(REPOSITORY, fresh, date)
            recipe = write_recipe(REPOSITORY, version, sdist, fresh / f"conformal_uv-{version}-conda.yaml")
            built = [*zips, wheel, sdist, recipe, build_site(REPOSITORY, version, fresh, date)]
            built.append(write_checksums(built, fresh / "SHA256SUMS"))
        return [Path(shutil.move(path, output / path.name)) for path in built]


def write_checksums(paths: list[Path], target: Path) -> Path:
    """A file as `sha256sum --check` reads it."""
    lines = (f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n" for path in sorted(paths))
    target.write_text("".join(lines), encoding="utf-8")
    return target


if __name__ == "__main__":
    sys.exit(main())
