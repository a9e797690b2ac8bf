"""Polyscope's window with a map in it, and a picture of that without any window."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ConformalUVError
from ..mapped_mesh import MappedMesh
from ..options import Upright
from .polyscope_scene import polyscope_scene

__all__ = ["show_in_window", "window_picture"]

WINDOWLESS = "openGL3_egl"  # how polyscope draws without a screen
SIZE = (1600, 900)  # of a picture, pixels


def show_in_window(polyscope: Any, mapped: MappedMesh, name: str, upright: Upright) -> None:
    """Open the window; come back when it is closed.

    Raises
    ------
    ConformalUVError
        There is no screen.
    """
    _quiet(polyscope)
    try:
        polyscope.init()
    except RuntimeError as error:
        raise ConformalUVError(
            f"polyscope can open no window here ({error}).", ways=("ask for a picture by --screenshot FILE",)
        ) from error
    polyscope_scene(polyscope, mapped, name, upright)
    polyscope.show()


def window_picture(polyscope: Any, mapped: MappedMesh, name: str, upright: Upright) -> NDArray[np.uint8]:
    """What the window would show, (900, 1600, 4), the highest row first.

    Raises
    ------
    ConformalUVError
        polyscope can not draw here.
    """
    _quiet(polyscope)
    polyscope.set_allow_headless_backends(True)
    try:
        polyscope.init(WINDOWLESS if sys.platform == "linux" else "auto")
    except RuntimeError as error:
        raise ConformalUVError(
            f"polyscope can not draw without a screen here ({error}); on Debian it needs libegl1 and libgl1-mesa-dri."
        ) from error
    polyscope.set_window_size(*SIZE)
    polyscope_scene(polyscope, mapped, name, upright)
    return np.ascontiguousarray(polyscope.screenshot_to_buffer(transparent_bg=False))


def _quiet(polyscope: Any) -> None:
    """Say nothing, and leave no files about windows where the command was called."""
    polyscope.set_verbosity(0)
    polyscope.set_use_prefs_file(False)
