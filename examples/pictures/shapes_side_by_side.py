"""Disk, free boundary, rectangle and sphere of the same surfaces side by side: a checker on them, and their errors.

python examples/pictures/shapes_side_by_side.py shapes.png [scan.obj]
"""

import sys

import numpy as np
from matplotlib import colormaps
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from scipy.spatial import ConvexHull

import conformal_uv as cuv
from conformal_uv.files import read_mesh
from conformal_uv.samples import mask

SQUARES = 24  # of the checker over the texture
WORST = 2.0  # degrees of angle error, the end of the scale


def closed_surface(count=40000, seed=3):
    """A bumpy ball: points of the sphere, joined as their convex hull is, moved in and out."""
    k = np.arange(count) + 0.5
    z, turn = 1 - 2 * k / count, np.pi * (1 + np.sqrt(5)) * k
    P = np.column_stack((np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z))
    F = ConvexHull(P).simplices
    F = np.where((np.linalg.det(P[F]) < 0)[:, None], F[:, ::-1], F)
    waves = np.random.default_rng(seed).normal(size=(6, 3)) * 2.0
    bumps = np.cos(P @ waves.T + np.arange(6)).sum(axis=1)
    return P * (1.0 + 0.07 * bumps)[:, None] * [1.0, 1.2, 0.9], F


def projected(V, F):
    """Triangles (m, 3, 2) seen from the front, z up or the surface's own front; those turned away are dropped."""
    a, b, c = (V[corner] for corner in F.T)
    normal = np.cross(b - a, c - a)
    seen = normal[:, 2] > 0
    order = np.argsort(V[F[seen]][:, :, 2].mean(axis=1))
    light = normal[seen] @ [0.25, 0.35, 0.9] / np.linalg.norm(normal[seen], axis=1)
    return V[F[seen]][order][:, :, :2], np.flatnonzero(seen)[order], 0.35 + 0.65 * np.clip(light, 0, 1)[order]


def drawn(axes, triangles, colours):
    """A picture of coloured triangles, no axes."""
    axes.add_collection(PolyCollection(triangles, facecolors=colours, edgecolors="face", linewidths=0.15))
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_axis_off()


def checker(place):
    """Colours of faces (m, 3, d) by the checker of squares or cubes that their middles lie in."""
    cell = np.floor(SQUARES * place.mean(axis=1)).astype(int).sum(axis=1) % 2
    return np.where(cell[:, None] == 1, [0.93, 0.9, 0.82], [0.2, 0.42, 0.6])


def column(axes, name, V, F, squares, image, measured):
    """The surface with its checker above; below, faces (k, 3, 2) of the map by the angle error of each."""
    flat, shown, light = projected(V, F)
    drawn(axes[0], flat, np.clip(checker(squares)[shown] * light[:, None], 0, 1))
    faces, which = image
    drawn(axes[1], faces, colormaps["viridis"](np.clip(measured.angle_error.mean(axis=1)[which] / WORST, 0, 1)))
    axes[0].set_title(name)
    axes[1].set_title(f"mean angle error {measured.angle_mean:.2f}°", fontsize=10)


def surface(path):
    """Vertices and triangles of a scan, or of the generated mask."""
    if path is None:
        return mask(50000)
    mesh = read_mesh(path).mesh
    used, F = np.unique(cuv.triangulate(mesh)[0], return_inverse=True)
    return mesh.V[used], F.reshape(-1, 3)


def diagonal_corners(V, F):
    """Four boundary vertices, those that lie farthest out along the diagonals of the picture."""
    loop = cuv.DiskMapper(V, F).boundary
    around = V[loop, :2] - V[loop, :2].mean(axis=0)
    around /= np.abs(around).max(axis=0)
    return [int(loop[np.argmax(around @ d)]) for d in ([-1, -1], [1, -1], [1, 1], [-1, 1])]


def main():
    """Draw and write the picture."""
    V, F = surface(sys.argv[2] if len(sys.argv) > 2 else None)
    figure = Figure(figsize=(15, 7.6), dpi=110, layout="constrained")
    axes = figure.subplots(2, 4)
    for k, shape in enumerate(("disk", "free", "rectangle")):
        pins = diagonal_corners(V, F) if shape == "rectangle" else None
        found = cuv.unwrap(V, F, shape=shape, upright="y", pins=pins)
        uv = found.uv.reshape(-1, 3, 2)
        column(axes[:, k], shape, V, F, uv, (uv, slice(None)), found.charts[0].distortion)
        print(f"{shape:10} {found.charts[0].distortion.angle_mean:.3f} degrees, {len(found.charts[0].flipped)} folds")
    V, F = closed_surface()
    ball = cuv.sphere_map(V, F, rotation="surface")
    column(
        axes[:, 3], "sphere, of a closed surface", V, F, 0.25 * ball.xyz[F], projected(ball.xyz, F)[:2], ball.distortion
    )
    print(f"sphere     {ball.distortion.angle_mean:.3f} degrees, {len(ball.flipped)} folds")
    figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "shapes.png")


if __name__ == "__main__":
    main()
