"""Crowding: square bands along a strip. In the disk each is exp(-pi) times as large as the one before."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from scene import save_figure
from surfaces import grid

import conformal_uv as cuv

LENGTH = 7
place, F = grid(60 * LENGTH + 1, 61)
place = place * [LENGTH, 1]
found = cuv.disk_map(np.column_stack((place, 0 * place[:, 0])), F, method="linear")
turned = cuv.Moebius.of_disk(0.0, -np.angle((found.uv @ [1, 1j])[place[:, 0] == LENGTH].mean()))
uv = turned(found.uv @ [1, 1j]).view(float).reshape(-1, 2)
band = np.floor(place[F].mean(axis=1)[:, 0])
figure = Figure(figsize=(9, 5.4), layout="constrained")
strip, *disks = (figure.add_subplot(*spot) for spot in ((5, 1, 1), (5, 3, (4, 13)), (5, 3, (5, 14)), (5, 3, (6, 15))))
strip.tripcolor(*place.T, F, band, cmap="viridis", vmin=0, vmax=LENGTH - 1)
strip.set_title("a strip, seven times as long as wide", fontsize=11)
for axes, most in zip(disks, (1.0, 0.06, 0.0025), strict=True):
    axes.tripcolor(*uv.T, F, band, cmap="viridis", vmin=0, vmax=LENGTH - 1)
    axes.add_artist(Circle((0, 0), 1, fill=False, lw=0.6))
    axes.set_xlim(1 - 2 * most, 1 + 0.02 * most)
    axes.set_ylim(-1.01 * most, 1.01 * most)
    axes.set_title("the disk" if most == 1 else f"its right end, {1 / most:.0f} times as large", fontsize=11)
for axes in figure.axes:
    axes.set_aspect("equal")
    axes.set_axis_off()
save_figure(figure, "crowding")
