"""The filter script that a MeshSet keeps of what was applied to it, without our inner steps.

pymeshlab's steps that carry the result over work on attributes of this one mesh; replayed on another they fail.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from xml.etree import ElementTree

__all__ = ["unrecorded"]


@contextmanager
def unrecorded(ms: Any) -> Iterator[None]:
    """Put the MeshSet's filter script back to what it was before the block."""
    with tempfile.TemporaryDirectory(prefix="conformal_uv_") as folder:
        script = os.path.join(folder, "script.mlx")
        ms.save_filter_script(script)
        try:
            yield
        finally:
            ms.clear_filter_script()
            if _filters(script):
                with _silent_stderr():  # pymeshlab tells there of every filter that it reads
                    ms.load_filter_script(script)


def _filters(script: str) -> bool:
    """Whether there is any in the script."""
    return ElementTree.parse(script).getroot().find("*") is not None


@contextmanager
def _silent_stderr() -> Iterator[None]:
    """Nothing that C++ code writes to standard error comes through."""
    sys.stderr.flush()
    kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)
