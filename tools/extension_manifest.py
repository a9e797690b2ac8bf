"""The extension's manifest, its version the project's one."""

from __future__ import annotations

import json
import runpy
from pathlib import Path

__all__ = ["VERSION", "manifest"]

VERSION: str = runpy.run_path(str(Path(__file__).resolve().parent.parent / "conformal_uv" / "_version.py"))[
    "__version__"
]

HEAD = """\
schema_version = "1.0.0"

id = "conformal_uv"
version = "{version}"
name = "Conformal Unwrap"
tagline = "Unwrap islands with their angles kept: free, disk or rectangle"
maintainer = "The conformal_uv authors"
type = "add-on"
tags = ["UV", "Mesh"]
blender_version_min = "4.2.0"
license = ["SPDX:GPL-3.0-or-later"]
"""

TAIL = """
[build]
paths_exclude_pattern = ["__pycache__/", "*.pyc", "/.*"]
"""


def manifest(wheels: list[Path], platforms: list[str]) -> str:
    """The text of blender_manifest.toml.

    Parameters
    ----------
    wheels : list of Path
        Bundled in the folder `wheels`.
    platforms : list of str
        Blender's names of them; empty where the extension runs on all.
    """
    text = HEAD.format(version=VERSION)
    if platforms:
        text += f"platforms = {json.dumps(platforms)}\n"
    listed = "".join(f"    {json.dumps('./wheels/' + wheel.name)},\n" for wheel in wheels)
    return f"{text}wheels = [\n{listed}]\n{TAIL}"
