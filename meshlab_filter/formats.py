"""Which files keep texture coordinates when pymeshlab writes them."""

from __future__ import annotations

import os
from pathlib import Path

from conformal_uv import FileFormatError

__all__ = ["UV_FORMATS", "check_target"]

UV_FORMATS = (".obj", ".ply", ".dae", ".off")


def check_target(path: str | os.PathLike[str]) -> Path:
    """The path, if a mesh with texture coordinates can be written there.

    Raises
    ------
    FileFormatError
        pymeshlab writes no such files, or they lose texture coordinates; the folder does not exist or is
        write-protected; the file is a folder or write-protected.
    """
    path = Path(path)
    if path.suffix.lower() not in UV_FORMATS:
        raise FileFormatError(
            f"{path}: pymeshlab writes no texture coordinates to {path.suffix or 'files without suffix'}; "
            f"use {', '.join(UV_FORMATS)}"
        )
    if not path.parent.is_dir():
        raise FileFormatError(f"{path}: the folder {path.parent} does not exist; create it first")
    if path.is_dir():
        raise FileFormatError(f"{path}: this is a folder; give the name of a file")
    if not os.access(path if path.exists() else path.parent, os.W_OK) or not os.access(path.parent, os.W_OK):
        raise FileFormatError(f"{path}: write-protected; choose another name or folder")
    return path
