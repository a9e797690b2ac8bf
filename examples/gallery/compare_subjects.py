"""Two cortices in one disk: left and mirrored right hemisphere, placed by two landmarks, and where they differ."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.tri import LinearTriInterpolator, Triangulation
from scene import save_figure
from surfaces import cortex

import conformal_uv as cuv


def flat(V, F):
    """The disk map, the middle of the lateral side at 0, the frontal pole to the right."""
    inner = np.setdiff1d(np.arange(len(V)), cuv.DiskMapper(V, F).boundary)
    lateral = inner[np.argmin(((V[inner] - [-66, -22, 8]) ** 2).sum(axis=1))]
    z = cuv.disk_map(V, F, center=int(lateral)).uv @ [1, 1j]
    return z * np.exp(-1j * np.angle(z[np.argmax(V[:, 1])]))


left, right = cortex("left"), cortex("right")
places = [flat(*left[:2])]
V, F, depth = right
places.append(flat(V * [-1, 1, 1], F[:, ::-1]))  # mirrored, it is a left hemisphere
x, y = np.meshgrid(np.linspace(-1, 1, 500), np.linspace(-1, 1, 500))
pictures = []
for z, (_, faces, sulci) in zip(places, (left, right), strict=True):
    pictures.append(LinearTriInterpolator(Triangulation(z.real, z.imag, faces), sulci)(x, y))
both = np.ma.corrcoef(np.ma.masked_invalid(pictures[0]).ravel(), np.ma.masked_invalid(pictures[1]).ravel())[0, 1]
print(f"correlation of sulcal depth {both:.3f}")
figure = Figure(figsize=(9, 3.3), layout="constrained")
titles = ("left hemisphere", "right, mirrored", f"difference (correlation {both:.2f})")
for axes, picture, title in zip(figure.subplots(1, 3), (*pictures, pictures[0] - pictures[1]), titles, strict=True):
    axes.imshow(picture, origin="lower", cmap="gray_r" if "dif" not in title else "coolwarm", vmin=-1.4, vmax=1.4)
    axes.set_title(title, fontsize=11)
    axes.set_axis_off()
save_figure(figure, "compare_subjects")
