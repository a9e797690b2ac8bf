"""Harmonic measure: how likely a walk at random, begun in the middle, first meets each part of the boundary.

The disk's rays end at equal shares of it: many where the boundary comes near, few in the ends of the petals.
"""

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from scene import save_figure

import conformal_uv as cuv
from conformal_uv.samples import irregular_disk

xy, F = irregular_disk(40000)
r, turn = np.hypot(*xy.T), np.arctan2(xy[:, 1], xy[:, 0])
place = xy * (0.76 + 0.24 * r**2 * np.cos(5 * turn) + 0.10 * r * np.cos(2 * turn + 1))[:, None]
found = cuv.disk_map(np.column_stack((place, 0 * r)), F)
z = found.uv @ [1, 1j]
figure = Figure(figsize=(9, 4.6), layout="constrained")
for axes, shown in zip(figure.subplots(1, 2), (place, found.uv), strict=True):
    axes.tricontour(*shown.T, F, np.abs(z), levels=np.arange(0.1, 1, 0.1), colors="#9bb4c7", linewidths=0.8)
    for half, middle in ((z.real, z.imag), (z.imag, -z.real)):  # rays, cut where the angle jumps
        for slope in np.tan(np.pi / 72 * np.arange(-18, 18, 2)):
            axes.tricontour(*shown.T, F, middle - slope * half, levels=[0], colors="#31688e", linewidths=0.7)
    loop = found.boundary
    ends = shown[np.append(loop, loop[0])]
    share = np.abs(np.diff(z[np.append(loop, loop[0])])) / np.linalg.norm(
        np.diff(place[np.append(loop, loop[0])], axis=0), axis=1
    )
    line = LineCollection(np.stack((ends[:-1], ends[1:]), axis=1), cmap="plasma", norm="log", linewidths=5)
    line.set_array(share / (2 * np.pi))
    line.set_clim(0.003, 0.6)
    axes.add_collection(line)
    axes.margins(0.03)
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_axis_off()
figure.colorbar(line, ax=figure.axes, label="harmonic measure per length", shrink=0.8)
save_figure(figure, "harmonic_measure")
