"""The operator Conformal Live Pins."""

import json

import bpy

from .dragged import Dragged, drag_refusal
from .edit_mode import target_objects
from .mouse import in_uv_editor, passes, pixels_per_uv, redraw, uv_at, window_region
from .words import shown, told

REACH = 20.0  # pixels, at the scale of the interface
PRECISE = 0.1  # of the mouse's way while Shift is held
HELP = "Drag a pin or a selected boundary UV   Shift: precise   Enter: confirm   Esc, right click: cancel"


class UV_OT_conformal_live(Dragged, bpy.types.Operator):
    """Pinned UVs dragged, the island following at once, angles kept"""

    bl_idname = "uv.conformal_live"
    bl_label = "Conformal Live Pins"
    bl_description = (
        "Drag pinned UVs, and the island follows at once, keeping angles; without a drag, map islands from their "
        "pins.\n"
        "Two pins or more stay where they are; three on a disk's boundary turn and slide the disk"
    )
    bl_options = {"REGISTER", "UNDO"}

    place: bpy.props.FloatVectorProperty(
        name="Place",
        description="Where the pin goes.\nIts island follows",
        size=2,
        precision=4,
        step=1,
        options={"SKIP_SAVE"},
    )
    object_name: bpy.props.StringProperty(options={"HIDDEN", "SKIP_SAVE"})
    corner: bpy.props.IntProperty(
        default=-1,
        description="A face corner with the UV that is dragged; -1: none, islands are unwrapped from their pins",
        options={"HIDDEN", "SKIP_SAVE"},
    )
    earlier: bpy.props.StringProperty(
        default="[]",
        description="Drags before that one: a list of [object, corner, u, v], as JSON",
        options={"HIDDEN", "SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context):
        why = drag_refusal(context)
        if why:
            cls.poll_message_set(why)
        return not why

    def execute(self, context):
        from conformal_uv import ConformalUVError

        from .live_pins import NO_PINS, PinnedObject
        from .live_uvs import LiveUVs
        from .uv_objects import uv_objects

        owners = [PinnedObject(read) for read in uv_objects(context, target_objects(context))]
        live = LiveUVs(context, [owner.read.ob for owner in owners])
        try:
            done = self._replay(owners, live) if self.corner >= 0 else self._from_pins(owners, live)
        except ConformalUVError as error:
            live.restore()
            self.report({"ERROR"}, error.told(lambda remedy: ""))
            return {"CANCELLED"}
        except BaseException:
            live.restore()
            raise
        if not done:
            live.restore()
            self.report({"ERROR"}, told(NO_PINS if self.corner < 0 else "there is no such UV to drag"))
            return {"CANCELLED"}
        for owner in owners:
            live.show(owner.read.ob)
        live.keep()
        self._tell(done, live.values)
        return {"FINISHED"}

    def invoke(self, context, event):
        from .live_pins import NO_HANDLE, NO_HANDLE_HERE, PinnedObject
        from .uv_objects import uv_objects

        if not in_uv_editor(context):
            return self.execute(context)
        self._area, self._region = context.area, window_region(context.area)
        self._owners = [PinnedObject(read) for read in uv_objects(context, target_objects(context))]
        self._by_press = event.type == "LEFTMOUSE" and event.value in {"PRESS", "CLICK_DRAG"}
        handle = self._handle_under(context, event)
        if not any(len(owner.handles) for owner in self._owners) or (self._by_press and handle is None):
            self.report({"INFO"}, told(NO_HANDLE_HERE if self._by_press else NO_HANDLE))
            return {"CANCELLED"}
        self._drags, self._drag, self._moved = [], None, []
        self._start(context)
        context.window_manager.modal_handler_add(self)
        if self._by_press and not self._take(context, event, handle):
            self.cancel(context)
            return {"CANCELLED"}
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "MOUSEMOVE":
            if self._drag is not None:
                self._move(context, event)
        elif event.type in {"ESC", "RIGHTMOUSE"} and event.value == "PRESS":
            self.cancel(context)
            self.report({"INFO"}, told("Cancelled; nothing was changed"))
            return {"CANCELLED"}
        elif event.type in {"RET", "NUMPAD_ENTER"} and event.value == "PRESS":
            return self._finish(context)
        elif event.type == "LEFTMOUSE" and event.value == "RELEASE":
            self._drag = None
            if self._by_press:
                return self._finish(context)
        elif event.type == "LEFTMOUSE" and event.value == "PRESS":
            handle = self._handle_under(context, event)
            if handle is not None:
                self._take(context, event, handle)
        elif passes(event):
            return {"PASS_THROUGH"}
        return {"RUNNING_MODAL"}

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        if self.corner >= 0:
            layout.prop(self, "place")

    def _replay(self, owners, live):
        """The drags that the properties tell of, done again."""
        drags = []
        named = {owner.read.ob.name: owner for owner in owners}
        for name, corner, *place in [*json.loads(self.earlier), [self.object_name, self.corner, *self.place]]:
            owner = named.get(name) or (owners[0] if owners and not name else None)
            if owner is None or not owner.has(corner):
                return []
            drags.append(owner.drag(int(owner.islands.point[corner])))
            drags[-1].move(live.values[owner.read.ob], place)
        return drags

    def _from_pins(self, owners, live):
        """Islands with pins mapped anew, the pins where they are."""
        drags = []
        for owner in owners:
            for island in owner.pinned_islands():
                point = owner.first_pin(island)
                drags.append(owner.drag(point))
                drags[-1].move(live.values[owner.read.ob], owner.uv[point])
        return drags

    def _handle_under(self, context, event):
        from .live_pins import nearest

        reach = REACH * context.preferences.system.ui_scale / pixels_per_uv(self._region)
        return nearest(self._owners, uv_at(self._region, event), reach)

    def _start(self, context):
        from .live_uvs import LiveUVs
        from .uv_overlay import UVOverlay, line_pairs

        self._live = LiveUVs(context, [owner.read.ob for owner in self._owners])
        self._overlay = UVOverlay()
        self._pairs = [line_pairs(owner.islands.sides) for owner in self._owners]
        self._show(context)

    def _take(self, context, event, handle):
        """Take hold of a UV vertex; whether its island can be moved."""
        from conformal_uv import ConformalUVError

        owner = self._owners[handle.owner]
        context.window.cursor_modal_set("WAIT")
        try:
            self._drag = owner.drag(handle.point)
        except ConformalUVError as error:
            self.report({"ERROR"}, error.told(lambda remedy: ""))
            return False
        finally:
            context.window.cursor_modal_restore()
        self._begun = [owner.read.ob.name, handle.corner, 0.0, 0.0]
        self._place, self._last = owner.uv[handle.point].copy(), None
        self._show(context)
        return True

    def _move(self, context, event):
        at = uv_at(self._region, event)
        if self._last is not None and at != self._last:
            part = PRECISE if event.shift else 1.0
            self._place += [part * (at[0] - self._last[0]), part * (at[1] - self._last[1])]
            if not self._drags or self._drags[-1] is not self._begun:
                self._drags.append(self._begun)
                self._moved.append(self._drag)
            self._begun[2:] = self._place.tolist()
            self._drag.move(self._live.values[self._drag.ob], self._begun[2:])
            self._live.show(self._drag.ob)
            self._show(context)
        self._last = at

    def _show(self, context):
        """Draw the present state."""
        from .uv_overlay import PINNED, SELECTED

        self._overlay.edges = [(owner.uv, pairs) for owner, pairs in zip(self._owners, self._pairs, strict=True)]
        self._overlay.points = [(owner.uv[owner.handles], SELECTED) for owner in self._owners]
        self._overlay.points += [(owner.uv[owner.pinned], PINNED) for owner in self._owners]
        text = ""
        if self._drag is not None:
            disk = self._drag.kind == "disk"
            shape = shown("Disk, three pins") if disk else shown("Free, {count} pins", count=self._drag.pins)
            text = f"{shape}   U {self._place[0]:.4f}   V {self._place[1]:.4f}"
        self._area.header_text_set(f"{shown('Conformal Live Pins')}   {text}")
        context.workspace.status_text_set(f"{text}      {shown(HELP)}")
        redraw(context, "IMAGE_EDITOR")

    def _finish(self, context):
        if not self._drags:
            self.cancel(context)
            return {"CANCELLED"}
        *earlier, (self.object_name, self.corner, *self.place) = self._drags
        self.earlier = json.dumps(earlier)
        self._live.keep()
        self._tell(self._moved, self._live.values)
        self._end(context)
        return {"FINISHED"}

    def _tell(self, drags, values):
        from .live_pins import mapped

        message = mapped(drags, values)
        self.report({"WARNING"} if ";" in message else {"INFO"}, message)

    def _end(self, context):
        self._live = self._drag = None
        self._overlay.remove()
        self._area.header_text_set(None)
        if context.workspace is not None:
            context.workspace.status_text_set(None)
        redraw(context, "IMAGE_EDITOR")
