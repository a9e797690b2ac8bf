"""The extension's own files: the add-on, and in it the core as a subpackage."""

from __future__ import annotations

from pathlib import Path

from .errors import ReleaseError
from .relative_imports import absolute_imports, with_relative_imports

__all__ = ["extension_files"]

CORE = "conformal_uv"
NOT_CARRIED = tuple(f"{CORE}/{name}" for name in ("cli/", "console/", "page/", "pictures/", "show/", "__main__.py"))
HIDDEN = ("__pycache__", ".")


def extension_files(repository: Path) -> dict[str, bytes]:
    """Names within the zip and what stands there, but for manifest and wheels.

    Raises
    ------
    ReleaseError
        If a module would import a package of ours from elsewhere.
    """
    addon, core = repository / "blender_addon", repository / CORE
    files = {"LICENSE": (repository / "LICENSE").read_bytes()}
    for name, path in _all_files(addon):
        data = path.read_bytes()
        files[name] = with_relative_imports(data.decode(), name).encode() if name.endswith(".py") else data
    for name, path in _all_files(core):
        inside = f"{CORE}/{name}"
        if inside.startswith(NOT_CARRIED):
            continue
        files[inside] = path.read_bytes()
        for line, found in absolute_imports(files[inside].decode(), inside) if name.endswith(".py") else []:
            raise ReleaseError(f"{inside}, line {line}: `{found}` must be relative, for the extension carries the core")
    return files


def _all_files(folder: Path) -> list[tuple[str, Path]]:
    """Names within the folder, with slashes, and paths; nothing hidden."""
    found = ((path.relative_to(folder), path) for path in sorted(folder.rglob("*")) if path.is_file())
    return [(name.as_posix(), path) for name, path in found if not any(part.startswith(HIDDEN) for part in name.parts)]
