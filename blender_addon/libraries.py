"""Whether what the extension computes with is there; looked for without importing it, to keep Blender's start short."""

from __future__ import annotations

import sys
from functools import cache
from importlib.util import find_spec

from .words import told


def missing_library() -> str:
    """What is missing and what to do, empty where nothing is."""
    name = _missing_name()
    if not name:
        return ""
    return told(
        "Blender's Python {version} has no {name}: install the extension's zip for this platform, or your "
        "distribution's package of {name}",
        version=f"{sys.version_info.major}.{sys.version_info.minor}",
        name=name,
    )


@cache
def _missing_name() -> str:
    for name in ("numpy", "scipy"):
        if name not in sys.modules and find_spec(name) is None:
            return name
    return ""
