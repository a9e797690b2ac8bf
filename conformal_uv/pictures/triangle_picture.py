"""Very many triangles in a figure, drawn into the picture's own pixels."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.artist import Artist, allow_rasterization

from .raster import SAMPLES, Floats, Picture, faces_in_front, painted

__all__ = ["TrianglePicture"]


class TrianglePicture(Artist):
    """Triangles (m, 3, 2) in data coordinates, of one colour (m, 4) each; a later one hides those before it."""

    def __init__(self, triangles: Floats, colours: Floats) -> None:
        super().__init__()
        self.triangles, self.colours = triangles, colours
        self._drawn: tuple[list[float], Picture] | None = None
        self.set_rasterized(True)
        self.set_in_layout(False)

    @allow_rasterization
    def draw(self, renderer: Any) -> None:
        """Draw into the pixels of the axes."""
        axes: Any = self.axes
        box = axes.bbox
        left, bottom = int(np.floor(box.x0)), int(np.floor(box.y0))
        shape = int(np.ceil(box.y1)) - bottom, int(np.ceil(box.x1)) - left
        place = [*box.bounds, *axes.transData.get_matrix().ravel()]
        if self._drawn is None or self._drawn[0] != place:  # a figure is drawn once to be laid out and once to be saved
            corners = axes.transData.transform(self.triangles.reshape(-1, 2)) - (left, bottom)
            faces = faces_in_front(SAMPLES * corners.reshape(-1, 3, 2), (SAMPLES * shape[0], SAMPLES * shape[1]))
            self._drawn = place, painted(faces, self.colours)
        context = renderer.new_gc()
        renderer.draw_image(context, left, bottom, self._drawn[1])
        context.restore()
