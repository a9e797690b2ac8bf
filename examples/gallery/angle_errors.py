"""The same mask as a disk, with a free boundary and as a rectangle, coloured by the angle error of its faces."""

import numpy as np
from matplotlib.figure import Figure
from scene import by_vertex, save_figure

import conformal_uv as cuv
from conformal_uv.samples import mask

V, F = mask(20000)
loop = cuv.DiskMapper(V, F).boundary
around = V[loop, :2] / np.abs(V[loop, :2]).max(axis=0)
corners = [int(loop[np.argmax(around @ d)]) for d in ([-1, -1], [1, -1], [1, 1], [-1, 1])]
figure = Figure(figsize=(9, 3.6), layout="constrained")
for axes, shape in zip(figure.subplots(1, 3), ("disk", "free", "rectangle"), strict=True):
    pins = corners if shape == "rectangle" else None
    found = cuv.unwrap(V, F, shape=shape, upright="y", pins=pins)
    error = found.charts[0].distortion.angle_error.mean(axis=1)
    shown = axes.tripcolor(
        *by_vertex(found, F).T, F, np.maximum(error, 1e-3), cmap="magma", norm="log", rasterized=True
    )
    shown.set_clim(0.01, 3.0)
    axes.set_title(f"{shape}: {found.charts[0].distortion.angle_mean:.2f}° in the mean")
    axes.set_aspect("equal")
    axes.set_axis_off()
figure.colorbar(shown, ax=figure.axes, label="degrees", shrink=0.8)
save_figure(figure, "angle_errors")
