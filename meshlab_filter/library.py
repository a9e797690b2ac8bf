"""pymeshlab, or why it can not be used here."""

from __future__ import annotations

import sys

from conformal_uv import ConformalUVError, MissingDependencyError

__all__ = ["pymeshlab"]

if "bpy" in sys.modules:
    raise ConformalUVError("pymeshlab and bpy can not share a process (their libraries clash); use one of each.")

try:
    import pymeshlab
except ImportError as error:
    raise MissingDependencyError(
        f'The filters need pymeshlab ({error}): pip install "conformal-uv[meshlab]". On a bare Debian or Ubuntu its '
        "system libraries are: apt-get install libgl1 libopengl0 libcom-err2 libgmp10 libxcb1 libbsd0."
    ) from error
