"""The project's one version number, wherever it is written."""

from __future__ import annotations

import re
from pathlib import Path

from .errors import ReleaseError

__all__ = ["agreed_version"]

WRITTEN = {  # file: the line that has it
    "conformal_uv/_version.py": r'^__version__ = "([^"]+)"',
    "CITATION.cff": r"^version: (\S+)",
    "CHANGELOG.md": r"^## (\S+)",
}


def agreed_version(repository: Path) -> str:
    """The version that `_version.py`, CITATION.cff and the first section of CHANGELOG.md agree on.

    Raises
    ------
    ReleaseError
        If a file does not tell it, or two differ.
    """
    found = {}
    for name, pattern in WRITTEN.items():
        match = re.search(pattern, (repository / name).read_text(encoding="utf-8"), re.MULTILINE)
        if match is None:
            raise ReleaseError(f"{name} tells no version: no line is like {pattern}")
        found[name] = match[1]
    if len(set(found.values())) > 1:
        told = ", ".join(f"{name} {version}" for name, version in found.items())
        raise ReleaseError(f"the version is not the same everywhere: {told}; make them one")
    return found["conformal_uv/_version.py"]
