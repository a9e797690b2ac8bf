"""Build and validate the Blender extension's zips.

    python -m tools.build_extension [--output dist/blender] [--platform linux-x64 ...]

One zip for each platform, with the project's own wheel and unmodified wheels of scipy, cvxopt, mapbox-earcut and
rectangle-packer for the Pythons of Blender 4.2 to 5.0 (3.11) and 5.1 to 5.2 (3.13); and one for Blenders of
distributions, whose Python has scipy already, with no wheel but the project's own, which runs on any Python. numpy is
Blender's own everywhere. The tool that builds and validates is Blender's, out of the bpy wheel.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from .extension_manifest import VERSION, manifest

REPOSITORY = Path(__file__).resolve().parent.parent
SOURCES = ("conformal_uv", "pyproject.toml", "README.md", "LICENSE")
PYTHONS = ("3.11", "3.13")
SCIPY = {"3.11": "1.15.3", "3.13": "1.18.1"}  # 3.11: the last that is quiet on the numpy 1.24 of Blender 4.2
PLATFORMS = {  # Blender's name: pip's, the newest first
    "linux-x64": ("manylinux_2_28_x86_64", "manylinux_2_17_x86_64"),
    "windows-x64": ("win_amd64",),
    "macos-arm64": ("macosx_12_0_arm64",),
    "macos-x64": ("macosx_10_14_x86_64",),
}
LAST_SCIPY = {("3.13", "macos-x64"): "1.17.1"}


def main(argv: list[str] | None = None) -> None:
    """Build everything that the arguments ask for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=Path, default=REPOSITORY / "dist" / "blender")
    parser.add_argument("--platform", action="append", choices=PLATFORMS, help="default: all, and one without")
    parser.add_argument("--wheels", type=Path, help="folder that keeps downloaded wheels")
    parser.add_argument("--bpy-python", default=os.environ.get("CONFORMAL_UV_BPY_PYTHON", sys.executable))
    arguments = parser.parse_args(argv)
    arguments.output.mkdir(parents=True, exist_ok=True)
    tool = extension_tool(arguments.bpy_python)
    with tempfile.TemporaryDirectory() as folder:
        own = own_wheel(Path(folder))
        kept = (arguments.wheels or Path(folder) / "downloads").resolve()
        platforms = arguments.platform or list(PLATFORMS)
        wheels = [wheel for platform in platforms for wheel in bundled_wheels(platform, kept)]
        built = build(tool, stage(Path(folder) / "bundled", [own, *wheels], platforms), arguments.output, split=True)
        if not arguments.platform:
            built += build(tool, stage(Path(folder) / "plain", [own], []), arguments.output, split=False)
    for path in built:
        print(path)


def extension_tool(bpy_python: str) -> list[str]:
    """Blender's command for extensions, out of the bpy wheel that this Python has."""
    found = subprocess.run(
        [bpy_python, "-c", "import importlib.util as u; print(u.find_spec('bpy').origin)"],
        capture_output=True,
        text=True,
        check=False,
    )
    home = Path(found.stdout.strip() or "nowhere").parent
    tools = sorted(home.glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py"))
    if found.returncode or not tools:
        raise SystemExit(f"{bpy_python} has no bpy: pip install bpy, or name a Python that has it with --bpy-python")
    tags = tools[0].parents[3] / "modules" / "_bpy_internal" / "extensions" / "tags.py"
    return [bpy_python, str(tools[0]), *([str(tags)] if tags.exists() else [])]


def own_wheel(folder: Path) -> Path:
    """The project's wheel, built from a copy so that nothing is left in the repository."""
    source = folder / "source"
    source.mkdir()
    for name in SOURCES:
        given = REPOSITORY / name
        if given.is_dir():
            shutil.copytree(given, source / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(given, source / name)
    _run(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", str(folder / "own"), str(source))
    return next((folder / "own").glob("conformal_uv-*.whl"))


def bundled_wheels(platform: str, folder: Path) -> list[Path]:
    """Wheels of what conformal_uv needs beside numpy, on one of Blender's platforms."""
    folder.mkdir(parents=True, exist_ok=True)
    found: list[Path] = []
    for python in PYTHONS:
        scipy = LAST_SCIPY.get((python, platform), SCIPY[python])
        found.append(_download(f"scipy=={scipy}", python, platform, folder, needed=True))
        found.append(_download("rectangle-packer>=2.0.2", python, platform, folder, needed=True))
        found.append(_download("mapbox-earcut>=1.0.1", python, platform, folder, needed=False))
        found.append(_download("cvxopt>=1.3.2", python, platform, folder, needed=False))
    return sorted({path for path in found if path is not None})


def _download(requirement: str, python: str, platform: str, folder: Path, *, needed: bool) -> Path | None:
    """The wheel that fits; None where there is none and it can be done without."""
    tags = [word for tag in PLATFORMS[platform] for word in ("--platform", tag)]
    with tempfile.TemporaryDirectory() as fresh:
        done = subprocess.run(
            [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary=:all:"]
            + ["--implementation", "cp", "--python-version", python, *tags]
            + ["--find-links", str(folder), "--dest", fresh, requirement],
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode and needed:
            raise SystemExit(f"No wheel of {requirement} for Python {python} on {platform}:\n{done.stderr}")
        if done.returncode:
            return None
        wheel = next(Path(fresh).glob("*.whl"))
        return Path(shutil.copy(wheel, folder / wheel.name))


def stage(folder: Path, wheels: list[Path], platforms: list[str]) -> Path:
    """The extension's files as they are zipped."""
    shutil.copytree(REPOSITORY / "blender_addon", folder, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(REPOSITORY / "LICENSE", folder / "LICENSE")
    (folder / "wheels").mkdir()
    for wheel in wheels:
        shutil.copy(wheel, folder / "wheels" / wheel.name)
    (folder / "blender_manifest.toml").write_text(manifest(wheels, platforms), encoding="utf-8")
    return folder


def build(tool: list[str], folder: Path, output: Path, *, split: bool) -> list[Path]:
    """Zip a staged extension with Blender's tool and validate what comes out."""
    python, script, *tags = tool
    allowed = ["--valid-tags", *tags] if tags else []
    with tempfile.TemporaryDirectory() as fresh:
        target = ["--output-dir", fresh, "--split-platforms"]
        if not split:
            target = ["--output-filepath", str(Path(fresh) / f"conformal_uv-{VERSION}-without_scipy.zip")]
        _run(python, script, "build", "--source-dir", str(folder), *target, *allowed)
        built = []
        for path in sorted(Path(fresh).glob("*.zip")):
            _run(python, script, "validate", *allowed, str(path))
            built.append(Path(shutil.copy(path, output / path.name)))
    return built


def _run(*command: str) -> None:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)}\n{done.stdout}{done.stderr}")


if __name__ == "__main__":
    main()
