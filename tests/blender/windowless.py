"""An operator's invoke and modal driven without a window: events, a region and a self that stand in for Blender's."""

from __future__ import annotations

from types import MethodType, SimpleNamespace

import bpy

SIDE = 500  # pixels of the unit square


class View:
    """What a region's View2D does, the unit square's corner at the region's."""

    def region_to_view(self, x, y):
        return x / SIDE, y / SIDE

    def view_to_region(self, u, v, clip=True):
        return round(u * SIDE), round(v * SIDE)


class Overlay:
    """Takes what would be drawn."""

    drawn = []

    def __init__(self):
        self.removed = False
        Overlay.drawn.append(self)

    def remove(self):
        self.removed = True


class Driven:
    """An operator's self: its properties by their defaults, its methods bound to this."""

    def __init__(self, cls, **properties):
        self._cls, self.told = cls, []
        for name in cls.__annotations__:
            setattr(self, name, properties.get(name, self._default(cls.__annotations__[name])))
        region = SimpleNamespace(type="WINDOW", x=0, y=0, view2d=View())
        self.headers = []
        area = SimpleNamespace(
            type="IMAGE_EDITOR",
            ui_type="UV",
            regions=[region],
            header_text_set=self.headers.append,
        )
        window = SimpleNamespace(
            screen=SimpleNamespace(areas=[]), cursor_modal_set=lambda kind: None, cursor_modal_restore=lambda: None
        )
        manager = SimpleNamespace(windows=[window], modal_handler_add=lambda operator: True)
        workspace = SimpleNamespace(status_text_set=lambda text: None)
        preferences = SimpleNamespace(system=SimpleNamespace(ui_scale=1.0))
        self.context = _Context(
            area=area, window=window, window_manager=manager, workspace=workspace, preferences=preferences
        )

    @staticmethod
    def _default(deferred):
        if "default" in deferred.keywords:
            return deferred.keywords["default"]
        kind = deferred.function.__name__
        zeros = (0.0,) * deferred.keywords.get("size", 0)
        return {"StringProperty": "", "FloatProperty": 0.0, "FloatVectorProperty": zeros}[kind]

    def __getattr__(self, name):
        found = getattr(self.__dict__["_cls"], name)
        return MethodType(found, self) if callable(found) else found

    def report(self, kind, text):
        self.told.append(text)

    def properties(self):
        """Keywords that make the operator do the same again."""
        return {name: getattr(self, name) for name in self._cls.__annotations__}

    def press(self, kind="LEFTMOUSE", at=(0.0, 0.0), value="PRESS", **more):
        """Send an event to invoke, or to modal where the operator runs."""
        event = SimpleNamespace(
            type=kind,
            value=value,
            mouse_x=at[0] * SIDE,
            mouse_y=at[1] * SIDE,
            shift=more.get("shift", False),
            ctrl=more.get("ctrl", False),
            ascii=more.get("ascii", ""),
        )
        if self.__dict__.get("_running"):
            done = self.modal(self.context, event)
        else:
            done = self.invoke(self.context, event)
        self._running = done in ({"RUNNING_MODAL"}, {"PASS_THROUGH"})
        return done

    def move(self, *places, **more):
        """Move the mouse over places, in UVs."""
        for at in places:
            assert self.press("MOUSEMOVE", at, "NOTHING", **more) == {"RUNNING_MODAL"}


class _Context:
    """bpy.context, some of it replaced."""

    def __init__(self, **replaced):
        self.__dict__.update(replaced)

    def __getattr__(self, name):
        return getattr(bpy.context, name)
