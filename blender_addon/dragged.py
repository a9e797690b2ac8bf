"""What the operators that drag UVs live have in common."""

from .edit_mode import target_objects
from .libraries import missing_library
from .words import told


def drag_refusal(context):
    """Why there is nothing to drag, empty where there may be something."""
    if context.mode not in {"OBJECT", "EDIT_MESH"}:
        return told("Go to Object Mode or to Edit Mode of a mesh")
    if not any(ob.data.uv_layers.active for ob in target_objects(context)):
        return told("Select a mesh object with a UV map")
    return missing_library()


class Dragged:
    """Of operators whose `_live` UVs are put back when nothing comes of it, and whose `_end` lets go of the window."""

    _live = None

    def cancel(self, context):
        """Everything back as it was: Esc, or Blender closes the window or loads another file."""
        if self._live is not None:
            self._live.restore()
            self._end(context)

    def _confirmed(self, event):
        """Enter; of a tool the mouse button let go, of a menu's operator pressed."""
        if event.type in {"RET", "NUMPAD_ENTER"}:
            return event.value == "PRESS"
        return event.type == "LEFTMOUSE" and event.value == ("RELEASE" if self._by_press else "PRESS")
