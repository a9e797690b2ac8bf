"""What operators have in common whose work a thread does while the window stays alive."""

from .words import told

RUNNING = "Wait for the work that is under way, or press Esc"


class InBackground:
    """A modal operator: progress is shown, Esc cancels, and every other event goes on to the editors, so that views can
    be turned meanwhile. When the thread has ended, `finished` is called.

    No reference into Blender's data is kept meanwhile: undo may make them invalid, and the user may change anything.
    """

    _worker = None
    _seconds = 0.0  # that a thread has spent already

    def begin(self, context, job):
        """Start the job; what invoke returns."""
        from .worker import Worker

        self._worker = Worker(self.bl_label, job)
        self._worker.start(context)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC" and event.value == "PRESS":
            self.cancel(context)
            self.report({"INFO"}, told("Cancelled; nothing was changed"))
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if self._worker.running:
            self._worker.show(context)
            return {"PASS_THROUGH"}
        worker, self._worker = self._worker, None
        self._seconds = worker.finish(context)
        return self.finished(context)

    def cancel(self, context):
        """Also when Blender closes the window or loads another file."""
        if self._worker is not None:
            self._worker.cancel(context)
            self._worker = None
