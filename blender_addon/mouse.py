"""The mouse over the UV editor: where it is in UVs, and which events a running tool leaves to Blender."""

from __future__ import annotations

import bpy

FAR = 4096.0
VIEW = {"MIDDLEMOUSE", "TRACKPADPAN", "TRACKPADZOOM", "MOUSEROTATE", "MOUSESMARTZOOM", "HOME", "NUMPAD_PERIOD"}
WHEELS = {"WHEELUPMOUSE", "WHEELDOWNMOUSE"}


def in_uv_editor(context: bpy.types.Context) -> bool:
    """Whether the operator was called from a UV editor."""
    return context.area is not None and context.area.ui_type == "UV" and window_region(context.area) is not None


def window_region(area: bpy.types.Area) -> bpy.types.Region | None:
    """The region that shows the UVs."""
    return next((region for region in area.regions if region.type == "WINDOW"), None)


def uv_at(region: bpy.types.Region, event: bpy.types.Event) -> tuple[float, float]:
    """The UV under the mouse."""
    return region.view2d.region_to_view(event.mouse_x - region.x, event.mouse_y - region.y)


def pixels_per_uv(region: bpy.types.Region) -> float:
    """How large the unit square is on the screen."""
    left, _ = region.view2d.view_to_region(0.0, 0.0, clip=False)
    right, _ = region.view2d.view_to_region(FAR, 0.0, clip=False)
    return (right - left) / FAR


def passes(event: bpy.types.Event) -> bool:
    """Whether an event moves the view, which it may while a tool runs."""
    return event.type in VIEW or event.type.startswith("NDOF") or (event.type in WHEELS and event.ctrl)


def redraw(context: bpy.types.Context, kind: str) -> None:
    """Draw all editors of a kind again."""
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == kind:
                area.tag_redraw()
