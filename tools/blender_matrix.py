"""Run Blender's tests over several versions of bpy, each in an environment of its own.

    python -m tools.blender_matrix [VERSION ...] [--folder DIR] [--python 3.13=/path/to/python3.13 ...]

Environments are made in the folder at the first run (a third of a gigabyte each) and used again. Run it from an
environment that has the test extra. Exit code 0 when all versions pass.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parent.parent
VERSIONS = {  # of bpy: Python, numpy as that Blender ships it, scipy as the extension brings it
    "4.2.23": ("3.11", "numpy==1.24.3", "scipy==1.15.3"),
    "4.5.15": ("3.11", "numpy==1.26.4", "scipy==1.15.3"),
    "5.0.1": ("3.11", "numpy==1.26.4", "scipy==1.15.3"),
    "5.2.3": ("3.13", "numpy>=2.3,<3", "scipy==1.18.1"),
}
ALSO = ("cvxopt>=1.3.2", "rectangle-packer>=2.0.2", "pytest>=8")
TESTS = ("tests/test_blender.py", "tests/test_blender_extension.py")


def main(argv: list[str] | None = None) -> int:
    """Run the versions that the arguments name, by default all."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("version", nargs="*", default=list(VERSIONS))
    parser.add_argument("--folder", type=Path, default=REPOSITORY / "build" / "blender")
    parser.add_argument("--python", action="append", default=[], metavar="VERSION=PATH")
    arguments = parser.parse_args(argv)
    unknown = set(arguments.version) - set(VERSIONS)
    if unknown:
        parser.error(f"no such version: {', '.join(sorted(unknown))}; choose from {', '.join(VERSIONS)}")
    interpreters = dict(given.split("=", 1) for given in arguments.python)
    codes = {}
    for version in arguments.version:
        python = environment(version, arguments.folder.resolve(), interpreters)
        print(f"bpy {version}", flush=True)
        codes[version] = subprocess.run(
            [sys.executable, "-m", "pytest", "-q", *TESTS],
            cwd=REPOSITORY,
            env={**os.environ, "CONFORMAL_UV_BPY_PYTHON": str(python)},
            check=False,
        ).returncode
    for version, code in codes.items():
        print(f"bpy {version}: {'passed' if code == 0 else 'FAILED'}")
    return 1 if any(codes.values()) else 0


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
