"""Which files keep texture coordinates when pymeshlab writes them."""

from __future__ import annotations

import os
from pathlib import Path

from conformal_uv import FileFormatError
from conformal_uv.files import check_place, is_stream

__all__ = ["UV_FORMATS", "check_target"]

UV_FORMATS = (".obj", ".ply", ".dae", ".off")


def check_target(path: str | os.PathLike[str]) -> Path:
    """The path, if a mesh with texture coordinates can be written there.

    Raises
    ------
    FileFormatError
        pymeshlab writes no such files, or they lose texture coordinates; the folder does not exist or is
        write-protected; the file is a folder, a device or write-protected.
    """
    path = Path(path)
    if path.suffix.lower() not in UV_FORMATS:
        raise FileFormatError(
            f"{path}: pymeshlab writes no texture coordinates to {path.suffix or 'files without suffix'}; "
            f"use {', '.join(UV_FORMATS)}"
        )
    if is_stream(path):
        raise FileFormatError(f"{path}: pymeshlab writes no devices or pipes; give the name of a file")
    check_place(path)
    return path
