"""Whether what the extension computes with is there; looked for without importing it, to keep Blender's start short."""

from __future__ import annotations

import sys
from functools import cache
from importlib.util import find_spec


@cache
def missing_library() -> str:
    """What is missing and what to do, empty where nothing is."""
    for name in ("numpy", "scipy"):
        if name not in sys.modules and find_spec(name) is None:
            version = f"{sys.version_info.major}.{sys.version_info.minor}"
            return (
                f"Blender's Python {version} has no {name}: install the extension's zip for this platform, "
                f"or your distribution's package of {name}"
            )
    return ""
