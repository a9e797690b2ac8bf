"""Convergence on a spherical cap, whose exact map is stereographic: angles of order one, positions of order two."""

import numpy as np
from matplotlib.figure import Figure
from scene import save_figure

import conformal_uv as cuv
from conformal_uv.samples import spherical_cap

CAP = 60.0  # degrees


def errors(count):
    """Mean angle error in degrees, and the largest error of a position in the unit disk."""
    V, F = spherical_cap(count, CAP)
    middle = int(np.argmax(V[:, 2]))
    found = cuv.disk_map(V, F, center=middle)
    exact = V[:, :2] @ [1, 1j] / (1 + V[:, 2]) / np.tan(np.radians(CAP) / 2)
    exact = cuv.Moebius.to_zero(exact[middle])(exact)
    z = found.uv @ [1, 1j]
    return found.distortion.angle_mean, np.abs(z * np.exp(1j * np.angle(np.vdot(z, exact))) - exact).max()


counts = np.array([250, 500, 1000, 2000, 4000, 8000, 16000, 32000, 64000])
angle, place = np.transpose([errors(int(n)) for n in counts])
rates = [2 * np.polyfit(np.log(counts), -np.log(error), 1)[0] for error in (angle, place)]
print(f"orders {rates[0]:.2f}, {rates[1]:.2f}")
figure = Figure(figsize=(7, 4.2), layout="constrained")
axes = figure.subplots()
for error, order, name in ((angle, 1, "mean angle error, degrees"), (place, 2, "largest error of a position")):
    axes.loglog(counts, error, "o-", label=name)
    axes.loglog(
        counts, 0.8 * error[0] * (counts / counts[0]) ** (-order / 2), ":", color="grey", label=f"order {order}"
    )
axes.set_xlabel("vertices")
axes.grid(True, which="both", alpha=0.25)
axes.legend()
save_figure(figure, "convergence")
