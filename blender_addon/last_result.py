"""The result that panels show, whether it still holds, and its numbers, measured beside the window."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Thread
from typing import TYPE_CHECKING

import bpy

if TYPE_CHECKING:
    from .results import UnwrapResult

PATIENCE = 0.02  # seconds that the window waits for numbers
SECONDS = 0.1  # between two looks for them

_kept: list[UnwrapResult] = []
_measuring: list[Thread] = []
_doubts: list[Callable[[], bool]] = []
_state = {"own": 0, "stale": False}


def keep(result: UnwrapResult, attended: bool = False) -> None:
    """Show this one from now on. Where somebody attends, its numbers are measured in a thread."""
    _kept[:] = [result]
    _measuring.clear()
    _doubts.clear()
    _state["stale"] = False
    if attended:
        thread = Thread(target=result.measure, name="conformal_uv numbers", daemon=True)
        _measuring.append(thread)
        thread.start()
        thread.join(PATIENCE)
        if thread.is_alive():
            bpy.app.timers.register(_look_again, first_interval=SECONDS)


def last() -> UnwrapResult | None:
    """The last result, None before the first."""
    return _kept[0] if _kept else None


def measured() -> bool:
    """Whether its numbers are at hand, or nobody else is at them."""
    return not any(thread.is_alive() for thread in _measuring)


def stale() -> bool:
    """Whether its meshes or UVs were changed since, or are gone."""
    result = last()
    gone = result is not None and any(ob.name not in bpy.data.objects for ob in result.objects)
    if _doubts:
        set_stale(_doubts[0]())
    return gone or _state["stale"]


def doubt(is_stale: Callable[[], bool]) -> None:
    """Something was changed: look closer when somebody asks."""
    _doubts[:] = [is_stale]


def set_stale(stale: bool) -> None:
    """Say so, and have panels drawn again."""
    _doubts.clear()
    if stale != _state["stale"]:
        _state["stale"] = stale
        _redraw()


def forget() -> None:
    """Show none."""
    _kept.clear()
    _measuring.clear()
    _doubts.clear()


@contextmanager
def own_change() -> Iterator[None]:
    """Changes within the block are the add-on's own: they do not make the result stale."""
    _state["own"] += 1
    try:
        yield
    finally:
        if bpy.app.background:
            _own_change_told()  # Blender tells of changes at any time after this: then they are doubts
        else:
            # In the next turn of the main loop, when Blender has told of them.
            bpy.app.timers.register(_own_change_told, persistent=True)


def changing() -> bool:
    """Whether the add-on itself is at work."""
    return _state["own"] > 0


def _own_change_told() -> None:
    _state["own"] -= 1


def _look_again() -> float | None:
    if not measured():
        return SECONDS
    _redraw()
    return None


def _redraw() -> None:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            for region in area.regions:
                if region.type == "UI" and area.type in {"IMAGE_EDITOR", "VIEW_3D"}:
                    region.tag_redraw()
