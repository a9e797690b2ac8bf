"""Run Blender's tests over several versions of bpy, on the extension as it is installed from its release zip.

    python -m tools.blender_matrix [VERSION ...] [--zips dist] [--folder DIR] [--python 3.13=/path/to/python3.13 ...]

`python -m tools.release` makes the zips. Environments, with bpy, its numpy and pytest and nothing that the extension
brings, are made in the folder at the first run (a third of a gigabyte each) and used again. Run it from an environment
that has the test extra. Exit code 0 when all versions pass.
"""

from __future__ import annotations

import argparse
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path

from .blender_tool import BlenderTool
from .errors import ReleaseError
from .extension_builds import Build
from .versions import agreed_version

REPOSITORY = Path(__file__).resolve().parent.parent
VERSIONS = {  # of bpy: Python, numpy as that Blender ships it
    "4.2.23": ("3.11", "numpy==1.24.3"),
    "4.5.15": ("3.11", "numpy==1.26.4"),
    "5.0.1": ("3.11", "numpy==1.26.4"),
    "5.2.3": ("3.13", "numpy>=2.3,<3"),
}
ALSO = ("pytest>=8",)
TESTS = ("tests/test_blender.py", "tests/test_blender_extension.py")
MODULE = "bl_ext.user_default.conformal_uv"
SYSTEMS = {"Linux": "linux", "Windows": "windows", "Darwin": "macos"}
MACHINES = {"x86_64": "x64", "AMD64": "x64", "aarch64": "arm64", "arm64": "arm64", "ARM64": "arm64"}


def main(argv: list[str] | None = None) -> int:
    """Run the versions that the arguments name, by default all."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("version", nargs="*", default=list(VERSIONS))
    parser.add_argument("--zips", type=Path, default=REPOSITORY / "dist")
    parser.add_argument("--folder", type=Path, default=REPOSITORY / "build" / "blender")
    parser.add_argument("--python", action="append", default=[], metavar="VERSION=PATH")
    arguments = parser.parse_args(argv)
    unknown = set(arguments.version) - set(VERSIONS)
    if unknown:
        parser.error(f"no such version: {', '.join(sorted(unknown))}; choose from {', '.join(VERSIONS)}")
    interpreters = dict(given.split("=", 1) for given in arguments.python)
    codes = {}
    for version in arguments.version:
        try:
            extension = release_zip(version, arguments.zips)
            python = environment(version, arguments.folder.resolve(), interpreters)
            print(f"bpy {version}, {extension.name}", flush=True)
            codes[version] = tested(python, extension)
        except ReleaseError as error:
            sys.stderr.write(f"{error}\n")
            return 1
    for version, code in codes.items():
        print(f"bpy {version}: {'passed' if code == 0 else 'FAILED'}")
    return 1 if any(codes.values()) else 0


def release_zip(version: str, folder: Path) -> Path:
    """The zip for a Blender on this machine. Raises ReleaseError if it is not there."""
    here = f"{SYSTEMS.get(platform.system(), platform.system())}-{MACHINES.get(platform.machine(), platform.machine())}"
    build = Build(here, f"cp{VERSIONS[version][0].replace('.', '')}")
    path = folder.resolve() / build.filename(agreed_version(REPOSITORY))
    if not path.exists():
        raise ReleaseError(f"{path} is not there: python -m tools.release --platform {here} --python {build.python}")
    return path


def tested(python: Path, extension: Path) -> int:
    """Exit code of the tests, on the extension installed into a user folder of its own. Raises ReleaseError where this
    Blender does not find it valid.
    """
    BlenderTool(str(python)).validate(extension)
    with tempfile.TemporaryDirectory() as resources:
        variables = {**os.environ, "BLENDER_USER_RESOURCES": resources, "CONFORMAL_UV_BPY_PYTHON": str(python)}
        script = REPOSITORY / "tests" / "blender" / "installed_extension.py"
        command = [str(python), str(script), resources, "install", str(extension)]
        code = subprocess.run(command, env=variables, check=False).returncode
        variables |= {"CONFORMAL_UV_BLENDER_MODULE": MODULE, "CONFORMAL_UV_EXTENSION_ZIP": str(extension)}
        command = [sys.executable, "-m", "pytest", "-q", *TESTS]
        return code or subprocess.run(command, cwd=REPOSITORY, env=variables, check=False).returncode


def environment(version: str, folder: Path, interpreters: dict[str, str]) -> Path:
    """The Python of a virtual environment with this bpy, made when it is not there."""
    home = folder / version
    python = home / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    done = home / "complete"
    if not done.exists():
        wanted, *requirements = VERSIONS[version]
        interpreter = interpreters.get(wanted, f"python{wanted}")
        subprocess.run([interpreter, "-m", "venv", "--clear", str(home)], check=True)
        subprocess.run(
            [str(python), "-m", "pip", "install", "--quiet", f"bpy=={version}", *requirements, *ALSO], check=True
        )
        done.touch()
    return python


if __name__ == "__main__":
    sys.exit(main())
