"""The extension's manifest."""

from __future__ import annotations

import json
from collections.abc import Iterable

from .extension_builds import Build

__all__ = ["manifest"]

WEBSITE = ""  # the project's public address; left out of the manifest while there is none

HEAD = """\
schema_version = "1.0.0"

id = "conformal_uv"
version = "{version}"
name = "Conformal Unwrap"
tagline = "Unwrap islands with their angles kept: free, disk or rectangle"
maintainer = "The conformal_uv authors"
type = "add-on"
tags = ["UV", "Mesh"]
license = ["SPDX:GPL-3.0-or-later"]
copyright = ["2026 The conformal_uv authors"]
blender_version_min = "{first}"
"""

TAIL = """
[permissions]
files = "Save presets, and read and write files that its command names"
"""


def manifest(build: Build, version: str, wheels: Iterable[str]) -> str:
    """The text of blender_manifest.toml.

    Parameters
    ----------
    build : Build
    version : str
        The project's.
    wheels : iterable of str
        Names of the files in the folder `wheels`.
    """
    first, end = build.blender
    text = HEAD.format(version=build.version(version), first=first)
    if end:
        text += f"blender_version_max = {json.dumps(end)}\n"
    if WEBSITE:
        text += f"website = {json.dumps(WEBSITE)}\n"
    if build.platform:
        text += f"platforms = {json.dumps([build.platform])}\n"
    listed = "".join(f"    {json.dumps('./wheels/' + name)},\n" for name in wheels)
    return text + (f"wheels = [\n{listed}]\n" if listed else "") + TAIL
